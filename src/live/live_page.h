#pragma once

#include <string_view>

#include "live/http_message.h"
#include "live/live_session.h"

namespace kagefude {

/// One file of the page, built into the program.
struct PageFile {
  std::string_view path;  ///< "/main.js"
  std::string_view type;
  std::string_view content;
};

/// The page's files; "/" is the page itself.
const std::vector<PageFile>& pageFiles();

/// Answers what the guard let through:
///   GET  /, /main.js ...   the page's files
///   GET  /tables           the parameter tables, as `passes --json` prints them, each with the
///   scopes
///                          where it may stand (look, light, style)
///   GET  /picture?seen=N&stage=S&exposure=E&display=D&view=V
///                          waits until there is a view above N (at most 20 s), then four bytes of
///                          length (little-endian), that many of JSON, and the stage's pixels
///                          (showStage) unless nothing is new
///   GET  /probe?x=X&y=Y    what lies at a pixel
///   GET  /strips           names of strips to choose from
///   GET  /strip?name=S     a small picture of one, as /picture sends it
///   GET  /paint            the table and the presets of painted strips (strip_easel.h)
///   POST /change           {"overrides": ["brush.contrast=0.3"], "input": 0}
///   POST /save             {"overrides": [...], "onDisk": as /picture had it}: writes them into
///                          the look's file
///   POST /strip?name=F     a picture's file: keeps it as a strip, {"strip": "strips/F"}, or has a
///                          {"question", "freeName"} first; &anyway=1: in spite of what is to mend
///   POST /paint            {"preset": "soft", "settings": ["bands=3"]}: the strip, as /picture
///   sends
///                          it; with ?name=F kept as a file
/// &packed=1 packs the pixels (pack_pixels.h).
/// Whatever else is a 404; what is no JSON or of another shape a 400 that says so.
HttpResponse answerPage(LiveSession& session, const HttpRequest& request);

}  // namespace kagefude
