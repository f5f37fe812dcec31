#pragma once

#include <map>
#include <string>

namespace kagefude {

/// A request as it came, its body whole.
struct HttpRequest {
  std::string method;
  std::string path;  ///< as sent, percent signs undone, without the query
  std::map<std::string, std::string> query{};
  std::string host{}, origin{}, fetchSite{};  ///< headers Host, Origin, Sec-Fetch-Site; "" without
  std::string body{};
};

struct HttpResponse {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body{};
  std::map<std::string, std::string> headers{};
};

}  // namespace kagefude
