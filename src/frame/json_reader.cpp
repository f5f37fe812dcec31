#include "frame/json_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/folder_bound.h"
#include "base/nearest_name.h"
#include "base/plain_file.h"
#include "frame/json_text.h"

namespace kagefude::detail {
namespace {

constexpr uint64_t largestFile = uint64_t{64} << 20;
constexpr size_t longestText = 4096;

// What a value is, short enough for a message.
std::string describe(const nlohmann::json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("a list of {}", value.size());
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  constexpr size_t longest = 60;
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

}  // namespace

nlohmann::json JsonPlace::parseFile(const std::filesystem::path& path) {
  const std::string text = readPlainFile(path, largestFile);
  const std::string beyond = beyondBounds(text);
  if (!beyond.empty()) throw InputError(fmt::format("{}: {}", path.string(), beyond));
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const bool ended = error.byte > text.size();
    throw InputError(
        fmt::format("{} is not valid JSON: {}", path.string(),
                    text.empty() ? "it is empty"
                    : ended      ? fmt::format("it ends after {} bytes, too early", text.size())
                            : fmt::format("trouble at byte {} of {}", error.byte, text.size())));
  } catch (const nlohmann::json::exception&) {
    throw InputError(
        fmt::format("{} is not valid JSON: a number in it is too large", path.string()));
  }
}

void JsonPlace::refuse(std::string_view expected) const {
  throw InputError(fmt::format("{}: {} should be {}, but is {}", file_->string(),
                               place_.empty() ? "the file" : place_, expected, describe(*value_)));
}

bool JsonPlace::has(std::string_view key) const {
  if (!value_->is_object()) refuse("an object");
  const auto found = value_->find(std::string(key));
  return found != value_->end() && !found->is_null();
}

JsonPlace JsonPlace::operator[](std::string_view key) const {
  const std::string place = place_.empty() ? std::string(key) : fmt::format("{}.{}", place_, key);
  if (!has(key)) {
    if (value_->contains(std::string(key)))
      throw InputError(
          fmt::format("{}: {} is null, but a value is needed", file_->string(), place));
    std::vector<std::string> known;
    for (const auto& item : value_->items()) known.push_back(item.key());
    throw InputError(
        fmt::format("{}: {} is missing{}", file_->string(), place, didYouMean(key, known)));
  }
  return {*file_, *value_->find(std::string(key)), place};
}

std::vector<JsonPlace> JsonPlace::list(size_t fewest, size_t most) const {
  if (!value_->is_array() || value_->size() < fewest || value_->size() > most) {
    refuse(fewest == most ? fmt::format("a list of {}", most)
                          : fmt::format("a list of {} to {}", fewest, most));
  }
  std::vector<JsonPlace> places;
  for (size_t i = 0; i < value_->size(); ++i) {
    places.emplace_back(*file_, (*value_)[i], fmt::format("{}[{}]", place_, i));
  }
  return places;
}

double JsonPlace::number(double least, double most) const {
  const double value = value_->is_number() ? value_->get<double>() : std::nan("");
  if (!(value >= least && value <= most)) {
    refuse(fmt::format("a number from {:g} to {:g}", least, most));
  }
  return value;
}

double JsonPlace::number() const {
  // Results of the arithmetic on these stay finite in double, and fit float where stored so.
  constexpr double large = 1e30;
  return number(-large, large);
}

int JsonPlace::integer(int least, int most) const {
  const double value = value_->is_number() ? value_->get<double>() : std::nan("");
  if (!(value >= least && value <= most) || value != std::floor(value)) {
    refuse(fmt::format("a whole number from {} to {}", least, most));
  }
  return static_cast<int>(value);
}

uint32_t JsonPlace::index() const {
  return static_cast<uint32_t>(integer(0, std::numeric_limits<int>::max()));
}

bool JsonPlace::boolean() const {
  if (!value_->is_boolean()) refuse("true or false");
  return value_->get<bool>();
}

std::string JsonPlace::text() const {
  if (!value_->is_string() || value_->get_ref<const std::string&>().size() > longestText) {
    refuse(fmt::format("a text of at most {} bytes", longestText));
  }
  return value_->get<std::string>();
}

std::string JsonPlace::name() const {
  std::string value = text();
  if (value.empty()) refuse("a name");
  return value;
}

size_t JsonPlace::choice(const std::vector<std::string>& choices) const {
  const std::string value = text();
  for (size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == value) return i;
  }
  refuse(fmt::format("one of {}", listNames(choices)));
}

V3d JsonPlace::vector() const {
  const auto numbers = list(3, 3);
  return {numbers[0].number(), numbers[1].number(), numbers[2].number()};
}

V3d JsonPlace::unitVector() const {
  const V3d value = vector();
  const double length = std::sqrt(value.x * value.x + value.y * value.y + value.z * value.z);
  if (!(length > 1e-12)) refuse("a direction, which has a length");
  return value / length;
}

Transform JsonPlace::matrix() const {
  Transform transform;
  const auto rows = list(4, 4);
  for (size_t i = 0; i < 4; ++i) {
    const auto row = rows[i].list(4, 4);
    for (size_t j = 0; j < 4; ++j) transform.m[i][j] = row[j].number();
  }
  return transform;
}

uint32_t JsonPlace::hexadecimal() const {
  const std::string digits = text();
  uint32_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, problem] = std::from_chars(digits.data(), end, value, 16);
  if (digits.size() != 8 || problem != std::errc() || stop != end) {
    refuse("eight hexadecimal digits");
  }
  return value;
}

std::filesystem::path JsonPlace::fileBeside() const {
  const std::filesystem::path relative = name();
  if (!staysInFolder(relative)) refuse("a path below the JSON's own folder");
  return file_->parent_path() / relative;
}

}  // namespace kagefude::detail
