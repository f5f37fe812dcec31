#include "live/http_server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "base/error.h"

namespace kagefude {
namespace {

/// A client that says just what a test wants.
class Client {
 public:
  explicit Client(uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in there{};
    there.sin_family = AF_INET;
    there.sin_port = htons(port);
    there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_, reinterpret_cast<sockaddr*>(&there), sizeof there) == 0;
    const timeval most{20, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  bool connected() const { return connected_; }
  /// False once the other side has closed.
  bool send(const std::string& text) const {
    for (size_t sent = 0; sent < text.size();) {
      const ssize_t now = ::send(socket_, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
      if (now <= 0) return false;
      sent += static_cast<size_t>(now);
    }
    return true;
  }
  std::string receive() const {
    std::string all;
    char buffer[4096];
    for (ssize_t got; (got = ::recv(socket_, buffer, sizeof buffer, 0)) > 0;)
      all.append(buffer, static_cast<size_t>(got));
    return all;
  }

 private:
  int socket_;
  bool connected_ = false;
};

class Server : public ::testing::Test {
 protected:
  std::string request(const std::string& method, const std::string& path,
                      const std::string& headers = "", const std::string& body = "") const {
    return fmt::format("{} {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n{}\r\n{}",
                       method, path, server.address().port, headers, body);
  }
  std::string ask(const std::string& text) const {
    const Client client(server.address().port);
    client.send(text);
    return client.receive();
  }
  std::string own(const std::string& tail) const {
    return "/" + server.address().token + "/" + tail;
  }
  static int statusOf(const std::string& response) {
    return response.size() < 12 ? 0 : std::atoi(response.c_str() + 9);
  }

  std::atomic<int> answered{0};
  HttpServer server{0, "0123456789abcdef0123456789abcdef", [this](const HttpRequest& request) {
                      ++answered;
                      if (request.path == "/throw") throw std::runtime_error("/secret/place");
                      return HttpResponse{.body = request.method + " " + request.path + " " +
                                                  request.query.at("a") + " " + request.body};
                    }};
};

TEST_F(Server, AnswersWithPathQueryAndBody) {
  const std::string response =
      ask(request("POST", own("set?a=b%20c"), "Content-Length: 5\r\n", "hello"));
  EXPECT_EQ(statusOf(response), 200) << response;
  EXPECT_NE(response.find("POST /set b c hello"), std::string::npos) << response;
}

TEST_F(Server, EveryResponseForbidsWhatOthersCouldDoWithIt) {
  for (const std::string& path : {own("x?a=1"), std::string("/wrong/")}) {
    const std::string response = ask(request("GET", path));
    for (const char* header :
         {"Content-Security-Policy: default-src 'none'", "frame-ancestors 'none'",
          "X-Content-Type-Options: nosniff", "Referrer-Policy: no-referrer",
          "Cache-Control: no-store", "Cross-Origin-Resource-Policy: same-origin"})
      EXPECT_NE(response.find(header), std::string::npos) << header;
    EXPECT_EQ(response.find("Access-Control-Allow"), std::string::npos);
  }
}

TEST_F(Server, WhatIsNotThePagesOwnNeverReachesTheAnswer) {
  EXPECT_EQ(statusOf(ask(request("GET", "/0123456789abcdef0123456789abcdee/x?a=1"))), 403);
  EXPECT_EQ(statusOf(ask(request("GET", own("x?a=1"), "Origin: http://evil.example\r\n"))), 403);
  EXPECT_EQ(statusOf(ask(request("POST", own("x?a=1"),
                                 "Origin: http://evil.example\r\nContent-Length: 2\r\n", "{}"))),
            403);
  EXPECT_EQ(statusOf(ask(request("GET", own("x?a=1"), "Sec-Fetch-Site: cross-site\r\n"))), 403);
  EXPECT_EQ(statusOf(ask("GET " + own("x?a=1") +
                         " HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n")),
            403);
  EXPECT_EQ(statusOf(ask("GET " + own("x?a=1") + " HTTP/1.0\r\n\r\n")), 403);
  EXPECT_EQ(statusOf(ask(request("GET", own("../../etc/passwd?a=1")))), 400);
  EXPECT_EQ(statusOf(ask(request("GET", own("%2e%2e/%2e%2e/etc/passwd?a=1")))), 400);
  EXPECT_EQ(statusOf(ask(request("DELETE", own("x?a=1")))), 405);
  EXPECT_EQ(answered, 0);
}

TEST_F(Server, RefusesAGigabyteBeforeItIsRead) {
  const Client client(server.address().port);
  ASSERT_TRUE(client.send(request("POST", own("x?a=1"), "Content-Length: 1073741824\r\n")));
  EXPECT_EQ(statusOf(client.receive()), 413);
  for (const char* length : {"18446744073709551617", "-1", "0x10"})
    EXPECT_GE(
        statusOf(ask(request("POST", own("x?a=1"), fmt::format("Content-Length: {}\r\n", length)))),
        400)
        << length;
  EXPECT_EQ(answered, 0);
}

TEST_F(Server, CutsABodyWithoutLengthAtTheLimit) {
  const Client client(server.address().port);
  ASSERT_TRUE(client.send(request("POST", own("x?a=1"), "Transfer-Encoding: chunked\r\n")));
  const std::string chunk = "10000\r\n" + std::string(0x10000, 'x') + "\r\n";
  int sent = 0;
  while (sent < 16384 && client.send(chunk)) ++sent;
  EXPECT_LT(sent, 1024) << "64 MiB and more were taken";
  EXPECT_NE(statusOf(client.receive()), 200);
  EXPECT_EQ(answered, 0);
}

TEST_F(Server, HeadersHaveALimit) {
  const std::string response =
      ask(request("GET", own("x?a=1"), "X: " + std::string(100000, 'x') + "\r\n"));
  EXPECT_NE(statusOf(response), 200);
  EXPECT_EQ(answered, 0);
}

TEST_F(Server, SaysNothingOfWhatWentWrongInside) {
  const std::string response = ask(request("GET", own("throw?a=1")));
  EXPECT_EQ(statusOf(response), 500);
  EXPECT_EQ(response.find("secret"), std::string::npos) << response;
}

TEST_F(Server, IsNotReachedFromOtherAddressesOfTheMachine) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(server.address().port);
  ASSERT_EQ(inet_pton(AF_INET, "127.0.0.2", &there.sin_addr), 1);
  EXPECT_NE(::connect(socket, reinterpret_cast<sockaddr*>(&there), sizeof there), 0);
  ::close(socket);
}

TEST_F(Server, APortThatIsTakenIsNamed) {
  const uint16_t port = server.address().port;
  try {
    const HttpServer second(port, "x", [](const HttpRequest&) { return HttpResponse(); });
    FAIL() << "two servers on one port";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(port)), std::string::npos);
  }
}

}  // namespace
}  // namespace kagefude
