#include "live/page_guard.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace kagefude {
namespace {

bool isOwnHost(const std::string& host, uint16_t port) {
  return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

bool isOwnOrigin(const std::string& origin, uint16_t port) {
  constexpr std::string_view scheme = "http://";
  return origin.starts_with(scheme) && isOwnHost(origin.substr(scheme.size()), port);
}

/// Looks at every byte, whichever differs.
bool sameSecret(const std::string& a, const std::string& b) {
  unsigned differs = a.size() == b.size() ? 0 : 1;
  for (size_t i = 0; i < a.size() && i < b.size(); ++i)
    differs |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return differs == 0;
}

bool leavesPage(const std::string& path) {
  return path.find("..") != std::string::npos || path.find('\\') != std::string::npos ||
         path.find('\0') != std::string::npos;
}

HttpResponse refusal(int status, const char* why) {
  return {.status = status, .body = std::string(why) + "\n"};
}

}  // namespace

std::string PageAddress::url() const { return fmt::format("http://127.0.0.1:{}/{}/", port, token); }

std::string randomToken() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "no random numbers for the token");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

size_t mostBody(const HttpRequest& request) {
  return request.method == "POST" && request.path == "/strip" ? size_t{64} << 20 : size_t{1} << 20;
}

std::optional<HttpResponse> refuse(HttpRequest& request, const PageAddress& address) {
  if (!isOwnHost(request.host, address.port)) return refusal(403, "this host is not served");
  if (!request.origin.empty() && !isOwnOrigin(request.origin, address.port))
    return refusal(403, "another page may not ask here");
  const std::string& site = request.fetchSite;
  if (!site.empty() && site != "same-origin" && site != "none")
    return refusal(403, "another page may not ask here");
  const size_t slash = request.path.find('/', 1);
  const std::string token =
      request.path.substr(0, slash == std::string::npos ? request.path.size() : slash);
  if (!sameSecret(token, "/" + address.token)) return refusal(403, "the address has a wrong token");
  if (slash == std::string::npos) return refusal(404, "the page's address ends in a slash");
  if (leavesPage(request.path)) return refusal(400, "paths do not leave the page");
  if (request.method != "GET" && request.method != "POST")
    return refusal(405, "only GET and POST are answered");
  request.path.erase(0, slash);
  return std::nullopt;
}

}  // namespace kagefude
