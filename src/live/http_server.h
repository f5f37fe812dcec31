#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "live/page_guard.h"

namespace kagefude {

/// Serves one page on 127.0.0.1 and nowhere else, by GNU libmicrohttpd.
///
/// Why that library, of the three that Debian 12 has (looked at in November 2026): civetweb 1.15
/// has a heap overflow in its reading of addresses (CVE-2025-55763, of 1.14 to 1.16), which its
/// package does not mend, and brings a file server and scripts that we would have to switch off.
/// Of cpp-httplib 0.11.4 the package mends one hole (CVE-2023-26130); open are, among others,
/// bodies without a length that grow without bound (CVE-2025-46728), lines without bound
/// (CVE-2025-53628), headers that pose as the library's own (GHSA-xm2j-vfr9-mg9m) and messages of
/// exceptions sent to the caller (CVE-2026-28434); compiled in from a header, they would stay until
/// we are built again. Of libmicrohttpd 0.9.75-6 one hole is mended (CVE-2023-27371, in a parser of
/// forms that we do not use), by the last entry of its changelog, of March 2023. What was published
/// later is not mended in Debian 12, security updates and proposed ones included (looked at on 29
/// November 2026): CVE-2025-59777 and CVE-2025-62689 (a crafted packet ends a program with 1.0.2
/// or earlier), nor what 1.0.4 to 1.0.9 mend (smuggled requests, which need a proxy before us, and
/// crashes and writes out of bounds "for certain requests in specific configurations"). The two
/// CVEs do not say where they lie. Experimental WebSockets, which 0.9.75 has and 1.0.10 has not,
/// are built only with --enable-experimental, which Debian does not give, and would be a library of
/// their own; we load libmicrohttpd.so.12 alone, without TLS, passwords, forms or upgrades. If they
/// lie elsewhere, whoever may connect to a port of this machine could end the page: the token is
/// looked at after the library has read the request. The look's file would stay as it is.
/// It serves no files and parses no bodies, hands the body over piece by piece so that its limit is
/// ours, takes an address to listen on and a limit of memory for headers, and is a shared library,
/// which Debian mends without us. It has no WebSockets, and none are wanted: the page asks for the
/// next picture and the answer waits until there is one (a long poll), which is one round trip, and
/// cannot queue pictures up, for a page that is slow asks later.
class HttpServer {
 public:
  using Answer = std::function<HttpResponse(const HttpRequest&)>;

  /// Listens on `port` (0: any that is free) and answers from then on, each connection in a thread
  /// of its own, at most 24 at a time; headers may take 32 KiB, bodies mostBody(), a silent
  /// connection 60 s. What page_guard.h refuses never reaches `answer`, and its body is not read.
  /// What `answer` throws becomes a 500 with no more than that. Every response forbids framing,
  /// sniffing, foreign scripts, caches and referrers. Throws OutputError when the port is taken.
  HttpServer(uint16_t port, std::string token, Answer answer);
  /// Waits for the answers that are being made: wake those that wait before.
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  const PageAddress& address() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kagefude
