#include "live/page_guard.h"

#include <gtest/gtest.h>

namespace kagefude {
namespace {

const PageAddress address{8123, "00112233445566778899aabbccddeeff"};

HttpRequest good() {
  return {.method = "GET",
          .path = "/" + address.token + "/main.js",
          .host = "127.0.0.1:8123",
          .origin = "http://127.0.0.1:8123",
          .fetchSite = "same-origin"};
}

int statusOf(HttpRequest request) {
  const auto refused = refuse(request, address);
  return refused ? refused->status : 200;
}

TEST(PageGuard, LetsThePageItselfThroughAndTakesItsTokenOff) {
  HttpRequest request = good();
  EXPECT_FALSE(refuse(request, address));
  EXPECT_EQ(request.path, "/main.js");
  request = good();
  request.path = "/" + address.token + "/";
  request.origin = request.fetchSite = "";
  EXPECT_FALSE(refuse(request, address));
  EXPECT_EQ(request.path, "/");
  request = good();
  request.host = "localhost:8123";
  request.fetchSite = "none";
  EXPECT_FALSE(refuse(request, address));
}

TEST(PageGuard, RefusesOtherHosts) {
  for (const char* host :
       {"", "evil.example", "evil.example:8123", "127.0.0.1", "127.0.0.1:80",
        "127.0.0.1:8123.evil.example", "localhost", "[::1]:8123", "0.0.0.0:8123"}) {
    HttpRequest request = good();
    request.host = host;
    EXPECT_EQ(statusOf(request), 403) << host;
  }
}

TEST(PageGuard, RefusesOtherOrigins) {
  for (const char* origin :
       {"null", "http://evil.example", "https://127.0.0.1:8123", "http://127.0.0.1",
        "http://127.0.0.1:9000", "http://127.0.0.1:8123.evil.example", "file://"}) {
    HttpRequest request = good();
    request.origin = origin;
    EXPECT_EQ(statusOf(request), 403) << origin;
  }
  for (const char* site : {"cross-site", "same-site", "odd"}) {
    HttpRequest request = good();
    request.fetchSite = site;
    EXPECT_EQ(statusOf(request), 403) << site;
  }
}

TEST(PageGuard, RefusesWrongTokens) {
  const std::string& token = address.token;
  for (const std::string& path :
       {std::string("/"), std::string(""), std::string("/main.js"), "/" + token.substr(1) + "/",
        "/" + token + "0/", "/" + std::string(32, '0') + "/", "//" + token + "/"}) {
    HttpRequest request = good();
    request.path = path;
    EXPECT_EQ(statusOf(request), 403) << path;
  }
  HttpRequest request = good();
  request.path = "/" + token;
  EXPECT_EQ(statusOf(request), 404);
}

TEST(PageGuard, RefusesPathsThatLeaveAndOtherMethods) {
  for (const std::string& tail : {std::string("../look.toml"), std::string("a/../../b"),
                                  std::string("a\\b"), std::string("a\0b", 3)}) {
    HttpRequest request = good();
    request.path = "/" + address.token + "/" + tail;
    EXPECT_EQ(statusOf(request), 400) << tail;
  }
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "HEAD", "TRACE", "get"}) {
    HttpRequest request = good();
    request.method = method;
    EXPECT_EQ(statusOf(request), 405) << method;
  }
}

TEST(PageGuard, OnlyAStripsFileMayBeLarge) {
  EXPECT_EQ(mostBody({.method = "POST", .path = "/strip"}), size_t{64} << 20);
  for (const char* path : {"/change", "/save", "/paint", "/strips", "/strip/", "/"})
    EXPECT_EQ(mostBody({.method = "POST", .path = path}), size_t{1} << 20) << path;
  EXPECT_EQ(mostBody({.method = "GET", .path = "/strip"}), size_t{1} << 20);
}

TEST(PageGuard, TokensAreLongAndNeverTheSame) {
  EXPECT_EQ(randomToken().size(), 32u);
  EXPECT_NE(randomToken(), randomToken());
}

}  // namespace
}  // namespace kagefude
