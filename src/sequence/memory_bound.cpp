#include "sequence/memory_bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "base/error.h"

namespace kagefude {
namespace {

std::optional<double> numberIn(const std::string& file) {
  std::ifstream in(file);
  double value = 0;
  if (in >> value) return value;  // "max", or no such file, is no number
  return std::nullopt;
}

/// What the machine could give without swapping, in bytes.
std::optional<double> machineMemory() {
  std::ifstream in("/proc/meminfo");
  std::string key;
  std::string unit;
  for (double value = 0; in >> key >> value; std::getline(in, unit))
    if (key == "MemAvailable:") return value * 1024;
  return std::nullopt;
}

/// The folder of this process's control group: version 2 has one line "0::/path".
std::string controlGroup() {
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("0::")) return "/sys/fs/cgroup" + line.substr(3);
  return "/sys/fs/cgroup";
}

/// What is left to the process of the limits of its control group and those above it.
std::optional<double> groupMemory() {
  std::optional<double> least;
  for (std::string folder = controlGroup(); folder.size() >= std::string("/sys/fs/cgroup").size();
       folder = folder.substr(0, folder.rfind('/'))) {
    const auto limit = numberIn(folder + "/memory.max");
    const auto used = numberIn(folder + "/memory.current");
    if (limit && used) least = std::min(least.value_or(*limit), std::max(0.0, *limit - *used));
  }
  return least;
}

}  // namespace

size_t parseMemory(std::string_view text) {
  const std::string copy(text);
  char* end = nullptr;
  const bool startsRight = !copy.empty() && (std::isdigit(copy[0]) || copy[0] == '.');
  const double value = startsRight ? std::strtod(copy.c_str(), &end) : 0;
  std::string unit = startsRight ? end : "?";
  std::erase(unit, ' ');
  for (char& c : unit) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  double scale = 0;
  if (unit.empty() || unit == "B") scale = 1;
  const std::string_view prefixes = "KMGT";
  for (size_t i = 0; i < prefixes.size(); ++i) {
    const std::string prefix(1, prefixes[i]);
    if (unit == prefix || unit == prefix + "B" || unit == prefix + "IB")
      scale = std::exp2(10.0 * static_cast<double>(i + 1));
  }
  const double bytes = value * scale;
  if (copy.find_first_of("xXpP") != std::string::npos || !(bytes >= 1) || bytes > 1e18)
    throw UsageError(fmt::format("memory '{}' is not an amount such as 8G, 512M or 1.5GiB", text));
  return static_cast<size_t>(bytes);
}

std::string formatMemory(size_t bytes) {
  const char* units[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
  double value = static_cast<double>(bytes);
  size_t unit = 0;
  for (; value >= 1024 && unit < 4; ++unit) value /= 1024;
  return unit == 0 ? fmt::format("{} bytes", bytes) : fmt::format("{:.1f} {}", value, units[unit]);
}

size_t defaultMemoryBound() {
  std::optional<double> least = machineMemory();
  if (const auto group = groupMemory()) least = std::min(least.value_or(*group), *group);
  if (!least) return size_t{1} << 30;
  return std::max(static_cast<size_t>(*least * 0.75), size_t{64} << 20);
}

}  // namespace kagefude
