// What comes in over the live page: requests, and what is saved into a look.
#include "base/error.h"
#include "fuzz/fuzz_file.h"
#include "fuzz/harness.h"
#include "live/page_guard.h"
#include "look/look.h"
#include "look/write_look.h"

namespace kagefude::fuzz {
namespace {

/// The text before the next `mark`, which is taken off.
std::string_view nextOf(std::string_view& input, std::string_view mark) {
  const size_t end = std::min(input.find(mark), input.size());
  const std::string_view part = input.substr(0, end);
  input.remove_prefix(std::min(end + mark.size(), input.size()));
  return part;
}

}  // namespace

/// A look, a line "====", and overrides, a line each. What is written means the look with them, and
/// what is said to bring it back does, where no entry is new.
void fuzzSave(std::string_view input) {
  const std::string text(nextOf(input, "\n====\n"));
  std::vector<std::string> overrides;
  while (!input.empty()) overrides.emplace_back(nextOf(input, "\n"));
  const std::string path = "fuzz.toml";
  WrittenLook written;
  Look before;
  try {
    before = readLookText(text, path, {});
    written = writeOverrides(text, path, overrides);
  } catch (const Error&) {
    return;
  }
  const Look after = readLookText(written.text, path, {});
  require(resolvedText(after) == resolvedText(readLookText(text, path, overrides)));
  if (after.styles.size() == before.styles.size() && after.lights.size() == before.lights.size())
    require(resolvedText(readLookText(written.text, path, written.before)) == resolvedText(before));
}

/// Method, path, Host, Origin and Sec-Fetch-Site, a line each. Who does not know the token never
/// gets past the guard, and nobody with a path that leaves the page.
void fuzzPageGuard(std::string_view input) {
  const PageAddress address{8080, "0123456789abcdef0123456789abcdef"};
  HttpRequest request;
  for (std::string* part :
       {&request.method, &request.path, &request.host, &request.origin, &request.fetchSite})
    *part = nextOf(input, "\n");
  const std::string asked = request.path;
  if (refuse(request, address)) return;
  require(asked.starts_with("/" + address.token + "/"));
  require(request.path.starts_with("/") && request.path.find("..") == std::string::npos);
  require(request.host == "127.0.0.1:8080" || request.host == "localhost:8080");
  require(request.origin.empty() || request.origin == "http://127.0.0.1:8080" ||
          request.origin == "http://localhost:8080");
  require(mostBody(request) <= size_t{64} << 20);
}

}  // namespace kagefude::fuzz
