#pragma once

#include <microhttpd.h>

namespace kagefude {

/// The functions of GNU libmicrohttpd that the page's server calls. The library is loaded when the
/// first page is served and not with the program: with it come those for TLS, and looking all of
/// them up would cost every comp of a frame about as much as half its start (measured: 20 starts in
/// 1.0 s of CPU instead of 0.7), and every machine of a farm a package.
struct Microhttpd {
  decltype(&MHD_start_daemon) startDaemon;
  decltype(&MHD_stop_daemon) stopDaemon;
  decltype(&MHD_lookup_connection_value) lookupConnectionValue;
  decltype(&MHD_get_connection_values) getConnectionValues;
  decltype(&MHD_create_response_from_buffer) createResponseFromBuffer;
  decltype(&MHD_add_response_header) addResponseHeader;
  decltype(&MHD_queue_response) queueResponse;
  decltype(&MHD_destroy_response) destroyResponse;

  /// Throws OutputError that names the package when the machine has not got it.
  static const Microhttpd& loaded();
};

}  // namespace kagefude
