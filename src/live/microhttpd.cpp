#include "live/microhttpd.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/error.h"

namespace kagefude {
namespace {

/// Of 0.9.60 to 1.0; the functions above are the same in all.
constexpr const char* libraryFile = "libmicrohttpd.so.12";

[[noreturn]] void refuse() {
  const char* const why = dlerror();
  throw OutputError(fmt::format(
      "the page's server cannot be started: {}; Debian's package libmicrohttpd12 has the library",
      why ? why : libraryFile));
}

template <class Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (!function) refuse();
}

/// Stays loaded: its threads may outlive the last server by a moment.
Microhttpd load() {
  void* const library = dlopen(libraryFile, RTLD_NOW | RTLD_LOCAL);
  if (!library) refuse();
  Microhttpd functions{};
  find(library, "MHD_start_daemon", functions.startDaemon);
  find(library, "MHD_stop_daemon", functions.stopDaemon);
  find(library, "MHD_lookup_connection_value", functions.lookupConnectionValue);
  find(library, "MHD_get_connection_values", functions.getConnectionValues);
  find(library, "MHD_create_response_from_buffer", functions.createResponseFromBuffer);
  find(library, "MHD_add_response_header", functions.addResponseHeader);
  find(library, "MHD_queue_response", functions.queueResponse);
  find(library, "MHD_destroy_response", functions.destroyResponse);
  return functions;
}

}  // namespace

const Microhttpd& Microhttpd::loaded() {
  static const Microhttpd functions = load();
  return functions;
}

}  // namespace kagefude
