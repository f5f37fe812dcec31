#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "live/http_message.h"

namespace kagefude {

/// Where the page is: http://127.0.0.1:port/token/.
struct PageAddress {
  uint16_t port = 0;
  std::string token;

  std::string url() const;
};

/// 128 bits from the system, as 32 hexadecimal digits. Throws std::system_error when it has none.
std::string randomToken();

/// Bytes that the body of a request may have that the guard let through: a strip's file 64 MiB, all
/// others 1 MiB.
size_t mostBody(const HttpRequest& request);

/// Who may ask for something: only who knows the token, and only as the page itself would.
/// - Host must be 127.0.0.1 or localhost with the port: a name of somebody else's that resolves to
///   this machine (DNS rebinding) is not.
/// - Origin, where a browser sends it, must be the page's own; Sec-Fetch-Site likewise must be
///   same-origin, or none for an address that was typed.
/// - The path must begin with the token; compared in a time that does not tell how much was right.
/// - The path has no "..", backslash or NUL in it, however spelled.
/// - GET and POST only.
/// Looks at headers alone, so it is asked before a body is read. Gives the refusal, or nothing;
/// then `path` has lost its token: "/main.js".
std::optional<HttpResponse> refuse(HttpRequest& request, const PageAddress& address);

}  // namespace kagefude
