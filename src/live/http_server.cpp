#include "live/http_server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "live/microhttpd.h"

namespace kagefude {
namespace {

constexpr unsigned mostConnections = 24, silentSeconds = 60;
constexpr size_t headerBytes = size_t{32} << 10;

/// A request while it comes in.
struct Incoming {
  HttpRequest request;
};

std::string headerOf(MHD_Connection* connection, const char* name) {
  const char* const value =
      Microhttpd::loaded().lookupConnectionValue(connection, MHD_HEADER_KIND, name);
  return value ? value : "";
}

MHD_Result addQuery(void* query, MHD_ValueKind, const char* key, const char* value) {
  static_cast<std::map<std::string, std::string>*>(query)->insert_or_assign(key,
                                                                            value ? value : "");
  return MHD_YES;
}

/// What every response says to the browser.
void addHeaders(MHD_Response* response, const HttpResponse& answer) {
  const auto add = [&](const char* name, const std::string& value) {
    Microhttpd::loaded().addResponseHeader(response, name, value.c_str());
  };
  add("Content-Type", answer.type);
  add("Cache-Control", "no-store");
  add("Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
      "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  add("Cross-Origin-Opener-Policy", "same-origin");
  add("Cross-Origin-Resource-Policy", "same-origin");
  add("Referrer-Policy", "no-referrer");
  add("X-Content-Type-Options", "nosniff");
  add("X-Frame-Options", "DENY");
  for (const auto& [name, value] : answer.headers) add(name.c_str(), value);
}

MHD_Result queue(MHD_Connection* connection, const HttpResponse& answer) {
  MHD_Response* const response = Microhttpd::loaded().createResponseFromBuffer(
      answer.body.size(), const_cast<char*>(answer.body.data()), MHD_RESPMEM_MUST_COPY);
  if (!response) return MHD_NO;
  addHeaders(response, answer);
  const MHD_Result queued = Microhttpd::loaded().queueResponse(
      connection, static_cast<unsigned>(answer.status), response);
  Microhttpd::loaded().destroyResponse(response);
  return queued;
}

HttpResponse tooLarge(size_t most) {
  return {.status = 413, .body = fmt::format("this may have at most {} bytes\n", most)};
}

/// A socket of our own, so that its port is known before the first request can come. Only what
/// comes from this machine reaches it.
int listenOnLoopback(uint16_t port, uint16_t& taken) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in loopback{};
  loopback.sin_family = AF_INET;
  loopback.sin_port = htons(port);
  loopback.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const address = reinterpret_cast<sockaddr*>(&loopback);
  socklen_t size = sizeof loopback;
  const int again = 1;
  if (socket < 0 || ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &again, sizeof again) != 0 ||
      ::bind(socket, address, size) != 0 || ::listen(socket, SOMAXCONN) != 0 ||
      ::getsockname(socket, address, &size) != 0) {
    const int why = errno;
    if (socket >= 0) ::close(socket);
    throw OutputError(fmt::format("cannot listen on 127.0.0.1:{}: {}", port, std::strerror(why)));
  }
  taken = ntohs(loopback.sin_port);
  return socket;
}

/// Whether the client says beforehand that the body is too large, or not in a number.
bool claimsTooMuch(MHD_Connection* connection, size_t most) {
  const std::string length = headerOf(connection, MHD_HTTP_HEADER_CONTENT_LENGTH);
  if (length.empty()) return false;
  constexpr size_t digits = 9;
  if (length.size() > digits || length.find_first_not_of("0123456789") != std::string::npos)
    return true;
  return std::stoul(length) > most;
}

}  // namespace

struct HttpServer::State {
  PageAddress address;
  Answer answer;
  MHD_Daemon* daemon = nullptr;

  /// The first call for a request has its headers, the next ones bring its body in pieces, the last
  /// one none.
  MHD_Result take(MHD_Connection* connection, const char* url, const char* method, const char* data,
                  size_t* size, void** own) {
    auto* incoming = static_cast<Incoming*>(*own);
    if (!incoming) {
      *own = incoming = new Incoming;
      HttpRequest& request = incoming->request;
      request.method = method;
      request.path = url;
      request.host = headerOf(connection, MHD_HTTP_HEADER_HOST);
      request.origin = headerOf(connection, MHD_HTTP_HEADER_ORIGIN);
      request.fetchSite = headerOf(connection, "Sec-Fetch-Site");
      if (const auto refused = refuse(request, address)) return queue(connection, *refused);
      const size_t most = mostBody(request);
      if (claimsTooMuch(connection, most)) return queue(connection, tooLarge(most));
      Microhttpd::loaded().getConnectionValues(connection, MHD_GET_ARGUMENT_KIND, &addQuery,
                                               &request.query);
      return MHD_YES;
    }
    std::string& body = incoming->request.body;
    if (*size > 0) {
      // What has no length is read to its limit; then the connection is cut.
      if (body.size() + *size > mostBody(incoming->request)) return MHD_NO;
      body.append(data, *size);
      *size = 0;
      return MHD_YES;
    }
    return queue(connection, answerOf(incoming->request));
  }

  HttpResponse answerOf(const HttpRequest& request) const {
    try {
      return answer(request);
    } catch (const std::exception&) {
      return {.status = 500, .body = "the program could not answer\n"};
    }
  }

  static MHD_Result take(void* self, MHD_Connection* connection, const char* url,
                         const char* method, const char*, const char* data, size_t* size,
                         void** own) {
    try {
      return static_cast<State*>(self)->take(connection, url, method, data, size, own);
    } catch (const std::exception&) {  // out of memory: nothing may pass through C
      return MHD_NO;
    }
  }

  static void forget(void*, MHD_Connection*, void** own, MHD_RequestTerminationCode) {
    delete static_cast<Incoming*>(*own);
    *own = nullptr;
  }
};

HttpServer::HttpServer(uint16_t port, std::string token, Answer answer)
    : state_(std::make_unique<State>()) {
  state_->address.token = std::move(token);
  state_->answer = std::move(answer);
  const Microhttpd& library = Microhttpd::loaded();
  const int socket = listenOnLoopback(port, state_->address.port);
  state_->daemon = library.startDaemon(
      MHD_USE_INTERNAL_POLLING_THREAD | MHD_USE_THREAD_PER_CONNECTION | MHD_USE_POLL,
      state_->address.port, nullptr, nullptr, &State::take, state_.get(), MHD_OPTION_LISTEN_SOCKET,
      socket, MHD_OPTION_NOTIFY_COMPLETED, &State::forget, nullptr, MHD_OPTION_CONNECTION_LIMIT,
      mostConnections, MHD_OPTION_CONNECTION_TIMEOUT, silentSeconds,
      MHD_OPTION_CONNECTION_MEMORY_LIMIT, headerBytes, MHD_OPTION_END);
  if (state_->daemon) return;
  ::close(socket);
  throw OutputError("the page's server cannot be started");
}

HttpServer::~HttpServer() { Microhttpd::loaded().stopDaemon(state_->daemon); }

const PageAddress& HttpServer::address() const { return state_->address; }

}  // namespace kagefude
