#include "sequence/report_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sequence/progress.h"
#include "sequence/report_plot.h"

namespace kagefude {
namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: dark; --ground: #1c1c1c; --panel: #242424; --line: #3a3a3a; --text: #d8d8d8;
  --soft: #9a9a9a; --accent: #7fb2d9; --block: #d9a65c; --bad: #e0705f; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--text);
  font: 15px/1.5 system-ui, "Noto Sans", "DejaVu Sans", sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 36px 24px 72px; }
h1 { font-size: 22px; font-weight: 600; margin: 0 0 4px; overflow-wrap: anywhere; }
h2 { font-size: 16px; font-weight: 600; margin: 40px 0 10px; }
p { margin: 4px 0; max-width: 76ch; }
a { color: inherit; }
code, pre { font: 13px/1.5 "DejaVu Sans Mono", ui-monospace, monospace; }
code { overflow-wrap: anywhere; }
.soft { color: var(--soft); }
.bad { color: var(--bad); }
.numbers { display: flex; flex-wrap: wrap; gap: 8px 36px; margin: 20px 0 0; padding: 0; }
.numbers div { min-width: 72px; }
.numbers b { display: block; font-size: 22px; font-weight: 600; font-variant-numeric: tabular-nums; }
.strip { display: flex; gap: 6px; overflow-x: auto; padding: 8px; background: var(--panel);
  scrollbar-color: #555 transparent; }
.strip a { flex: none; text-decoration: none; color: var(--soft); font-size: 12px;
  font-variant-numeric: tabular-nums; }
.strip img, .strip .none { display: block; height: 90px; }
.strip .none { width: 120px; border: 1px solid var(--bad); }
.strip .pop { color: var(--block); } .strip .fail { color: var(--bad); }
svg { display: block; width: 100%; background: var(--panel); }
svg text { fill: var(--soft); font-size: 12px; font-variant-numeric: tabular-nums; }
.grid { stroke: var(--line); }
.key { display: inline-block; width: 18px; height: 3px; vertical-align: middle; margin: 0 6px 0 0; }
.legend { display: flex; flex-wrap: wrap; gap: 2px 22px; margin: 6px 0 0; max-width: none; color: var(--soft); }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th { text-align: left; font-weight: 500; color: var(--soft); }
th, td { padding: 6px 14px 6px 0; border-bottom: 1px solid var(--line); vertical-align: middle; }
td.n, th.n { text-align: right; }
td img { display: block; height: 54px; }
td.what { width: 46%; overflow-wrap: anywhere; }
tr:target { background: #30383e; }
pre { background: var(--panel); padding: 16px; overflow: auto; max-height: 70vh; margin: 0; }
)css";

std::string filmstrip(const StripView& view) {
  std::string html = "<div class=\"strip\">\n";
  for (size_t i = 0; i < view.strip.entries.size(); ++i) {
    const ReportEntry& entry = *view.strip.entries[i];
    const bool failed = !entry.frame.failure.empty();
    const char* kind = failed ? " class=\"fail\"" : view.pops.contains(i) ? " class=\"pop\"" : "";
    html += fmt::format("<a href=\"#{}\"{}>", anchor(view.number, entry.frame), kind);
    html += entry.image.empty()
                ? "<span class=\"none\"></span>"
                : fmt::format("<img src=\"{}\" alt=\"frame {}\" loading=\"lazy\">",
                              escapeHtml(entry.image), escapeHtml(frameName(entry.frame)));
    html += fmt::format("{}{}</a>\n", entry.frame.frame,
                        failed                  ? " failed"
                        : view.pops.contains(i) ? " jump"
                                                : "");
  }
  return html + "</div>\n";
}

std::string remarks(const StripView& view, size_t i) {
  const ReportFrame& frame = view.frame(i);
  std::vector<std::string> lines;
  if (!frame.failure.empty())
    lines.push_back(fmt::format("<span class=\"bad\">{}</span>", escapeHtml(frame.failure)));
  if (frame.kept) lines.push_back("<span class=\"soft\">was done already</span>");
  if (view.pops.contains(i)) lines.push_back("changes more than its neighbours");
  for (const std::string& warning : frame.warnings) lines.push_back(escapeHtml(warning));
  return fmt::format("{}", fmt::join(lines, "<br>"));
}

std::string row(const StripView& view, size_t i) {
  const ReportEntry& entry = *view.strip.entries[i];
  const ReportFrame& frame = entry.frame;
  std::string html = fmt::format("<tr id=\"{}\"><td class=\"n\">{}</td><td>",
                                 anchor(view.number, frame), escapeHtml(frameName(frame)));
  if (!entry.image.empty())
    html += fmt::format("<a href=\"{0}\"><img src=\"{0}\" alt=\"\" loading=\"lazy\"></a>",
                        escapeHtml(entry.image));
  html += "</td>";
  for (const double seconds : {frame.readSeconds, frame.computeSeconds, frame.writeSeconds})
    html += fmt::format("<td class=\"n\">{:.2f}</td>", seconds);
  html += view.largest[i] < 0
              ? std::string("<td class=\"n\"></td>")
              : fmt::format("<td class=\"n\">{:.2f} / {:.1f}</td>", view.mean[i], view.largest[i]);
  return html + fmt::format("<td class=\"what\">{}</td></tr>\n", remarks(view, i));
}

std::string table(const StripView& view) {
  std::string html =
      "<table><thead><tr><th class=\"n\">frame</th><th></th><th class=\"n\">read s</th>"
      "<th class=\"n\">compute s</th><th class=\"n\">write s</th><th class=\"n\">change</th>"
      "<th>remarks</th></tr></thead><tbody>\n";
  for (size_t i = 0; i < view.strip.entries.size(); ++i) html += row(view, i);
  return html + "</tbody></table>\n";
}

std::string numbers(const std::vector<StripView>& views) {
  size_t frames = 0, failed = 0, kept = 0, warned = 0, pops = 0;
  double seconds = 0;
  for (const StripView& view : views) {
    pops += view.pops.size();
    for (const ReportEntry* entry : view.strip.entries) {
      ++frames;
      failed += entry->frame.failure.empty() ? 0 : 1;
      kept += entry->frame.kept ? 1 : 0;
      warned += entry->frame.warnings.empty() ? 0 : 1;
      seconds += entry->frame.readSeconds + entry->frame.computeSeconds + entry->frame.writeSeconds;
    }
  }
  const auto box = [](const std::string& value, const char* label, bool bad) {
    return fmt::format("<div><b{}>{}</b><span class=\"soft\">{}</span></div>\n",
                       bad ? " class=\"bad\"" : "", value, label);
  };
  return "<div class=\"numbers\">\n" + box(fmt::format("{}", frames), "frames", false) +
         box(fmt::format("{}", failed), "failed", failed > 0) +
         box(fmt::format("{}", kept), "done already", false) +
         box(fmt::format("{}", warned), "with warnings", false) +
         box(fmt::format("{}", pops), "jumps", pops > 0) +
         box(formatDuration(seconds), "work, all frames", false) + "</div>\n";
}

std::string section(const StripView& view) {
  const std::string of = view.strip.view.empty() ? "" : ": " + escapeHtml(view.strip.view);
  std::string html = fmt::format("<h2>Filmstrip{}</h2>\n{}", of, filmstrip(view));
  html += fmt::format("<h2>Change from the frame before{}</h2>\n{}", of, changePlot(view));
  html +=
      "<p class=\"legend\"><span><i class=\"key\" style=\"background:var(--accent)\"></i>mean of "
      "the "
      "picture</span><span><i class=\"key\" style=\"background:var(--block)\"></i>largest block "
      "</span><span><i class=\"key\" style=\"background:var(--bad)\"></i>stands out, or failed"
      "</span><span>in steps of 8-bit display values</span></p>\n";
  html += fmt::format("<h2>Time per frame{}</h2>\n{}", of, timePlot(view));
  html +=
      "<p class=\"legend\"><span><i class=\"key\" "
      "style=\"background:#5f7d95\"></i>read</span><span>"
      "<i class=\"key\" style=\"background:#7fb2d9\"></i>compute</span><span><i class=\"key\" "
      "style=\"background:#b9d3e6\"></i>write</span><span>in seconds; neighbouring frames "
      "overlap</span></p>\n";
  return html + fmt::format("<h2>Frames{}</h2>\n{}", of, table(view));
}

}  // namespace

std::string reportPage(const ReportHeader& header, const std::vector<ReportStrip>& strips) {
  std::vector<StripView> views;
  for (size_t i = 0; i < strips.size(); ++i) views.emplace_back(strips[i], i);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>{}</title><style>{}</style></head><body><main>\n<h1>{}</h1>\n",
      escapeHtml(header.title), kStyle, escapeHtml(header.title));
  html += fmt::format("<p class=\"soft\"><code>{}</code></p>\n", escapeHtml(header.command));
  html += numbers(views);
  for (const StripView& view : views) html += section(view);
  html += fmt::format("<h2>Look, with every value resolved</h2>\n<pre>{}</pre>\n",
                      escapeHtml(header.look));
  return html + fmt::format("<p class=\"soft\">kagefude {}</p>\n</main></body></html>\n",
                            escapeHtml(header.version));
}

}  // namespace kagefude
