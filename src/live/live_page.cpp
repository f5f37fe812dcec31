#include "live/live_page.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "live/pack_pixels.h"
#include "live/probe.h"
#include "live/show_stage.h"
#include "live/strip_choice.h"
#include "live/strip_easel.h"
#include "look/parameter_json.h"

namespace kagefude {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::seconds longestPoll{20};

HttpResponse json(const Json& value) {
  return {.type = "application/json",
          .body = value.dump(-1, ' ', true, Json::error_handler_t::replace)};
}

std::string textOf(const HttpRequest& request, const std::string& name,
                   const std::string& otherwise = "") {
  const auto given = request.query.find(name);
  return given == request.query.end() ? otherwise : given->second;
}

/// A query's number, which is finite, or what stands for none. Throws InputError.
template <class Number>
Number numberOf(const HttpRequest& request, const std::string& name, Number otherwise) {
  const auto given = request.query.find(name);
  if (given == request.query.end()) return otherwise;
  const std::string& text = given->second;
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() ||
      !std::isfinite(static_cast<double>(value)))
    throw InputError(fmt::format("{} must be a number, but is \"{}\"", name, text));
  return value;
}

Json tables() {
  Json list = Json::array();
  for (const LookSection& section : lookSections) {
    Json table = jsonOf(*section.table);
    table["list"] = section.isList();
    table["scopes"] = Json::array();
    for (const Scope scope : {Scope::look, Scope::light, Scope::style})
      if (actsIn(scope, section)) table["scopes"].push_back(scopeNames[static_cast<size_t>(scope)]);
    table["wholeLookKey"] = section.wholeLookKey;
    list.push_back(std::move(table));
  }
  return list;
}

Json valuesOf(const ParameterTable& table, const void* params) {
  Json values = Json::object();
  for (const Parameter& p : table.parameters)
    values[std::string(p.name)] = jsonOf(p, p.get(params));
  return values;
}

/// The look as it is resolved: of every section, light and style each value.
Json valuesOf(Look look) {
  Json values{{"look", Json::object()}, {"light", Json::array()}, {"style", Json::array()}};
  for (const LookSection& section : lookSections)
    if (section.inLook)
      values["look"][std::string(section.table->pass)] =
          valuesOf(*section.table, section.inLook(look));
  for (LightLook& light : look.lights) {
    Json own{{"light", valuesOf(lightTable, &light.light)}};
    for (const LookSection& section : lookSections)
      if (section.inLight)
        own[std::string(section.table->pass)] = valuesOf(*section.table, section.inLight(light));
    values["light"].push_back(std::move(own));
  }
  for (StyleLook& style : look.styles) {
    Json own{{"style", valuesOf(styleTable, &style.style)}};
    for (const LookSection& section : lookSections)
      if (section.inStyle)
        own[std::string(section.table->pass)] = valuesOf(*section.table, section.inStyle(style));
    values["style"].push_back(std::move(own));
  }
  return values;
}

Json listOf(const V3f& v) { return {v.x, v.y, v.z}; }

/// The lights as they stand, and the picture's axes in the world, by which a light is dragged; only
/// where a light may be moved.
void addLights(Json& state, const FramePlan& plan) {
  if (!plan.hasCasters || !plan.sidecar) return;
  const Transform& camera = plan.sidecar->camera.cameraFromWorld;
  for (const int row : {0, 1})
    state["axes"].push_back({camera.m[row][0], camera.m[row][1], camera.m[row][2]});
  for (const FrameLight& light : plan.lights)
    state["lights"].push_back({{"name", light.name},
                               {"type", lightTypeNames[static_cast<size_t>(light.light.type)]},
                               {"position", listOf(light.light.position)},
                               {"direction", listOf(light.light.direction)},
                               {"subject", listOf(light.subjectCentre)}});
}

Json describe(const LiveSession& session, const LiveView& view) {
  Json state{{"version", view.version}, {"change", view.change}, {"error", view.error}};
  state["inputs"] = Json::array();
  for (const LiveInput& input : session.settings().inputs)
    state["inputs"].push_back(input.path.filename().string());
  if (!view.picture) return state;
  const LivePicture& picture = *view.picture;
  state["input"] = view.input;
  state["step"] = picture.step;
  state["onDisk"] = {{"style", view.onDisk.styles}, {"light", view.onDisk.lights}};
  state["painted"] = {picture.stages.planes->width, picture.stages.planes->height};
  state["stages"] = stageNames(picture);
  const Colour& colour = *picture.colour;
  for (const std::string& display : colour.displays())
    state["displays"][display] = colour.views(display);
  state["made"] = picture.made;
  addLights(state, *picture.plan);
  state["warnings"] = picture.stages.warnings;
  state["values"] = valuesOf(*picture.look);
  return state;
}

void addLength(std::string& bytes, size_t length) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<char>(static_cast<unsigned char>(length >> shift)));
}

/// What the page reads pixels from: the length of the state, the state, the pixels, packed when it
/// asks for that.
HttpResponse withPixels(Json state, const ShownPixels& pixels, const HttpRequest& request) {
  const bool packed = request.query.contains("packed");
  state["packed"] = packed;
  if (pixels.width > 0) state["size"] = {pixels.width, pixels.height};
  const std::string text = state.dump(-1, ' ', true, Json::error_handler_t::replace);
  HttpResponse response{.type = "application/octet-stream"};
  addLength(response.body, text.size());
  response.body += text;
  if (packed)
    response.body += packPixels(pixels);
  else
    response.body += pixels.bytes;
  return response;
}

/// In stops; beyond these every picture is black or white.
float exposureOf(const HttpRequest& request) {
  constexpr float most = 100;
  const auto exposure = numberOf<float>(request, "exposure", 0);
  if (std::abs(exposure) > most)
    throw InputError(fmt::format("exposure must be -{0} to {0} stops, but is {1}", most, exposure));
  return exposure;
}

HttpResponse picture(const LiveSession& session, const HttpRequest& request) {
  const auto seen = numberOf<uint64_t>(request, "seen", 0);
  const Viewing viewing{exposureOf(request), textOf(request, "display"), textOf(request, "view")};
  const LiveView view = session.view(seen, longestPoll);
  ShownPixels pixels;
  if (view.version > seen && view.picture)
    pixels = showStage(*view.picture, textOf(request, "stage", "result"), viewing);
  return withPixels(describe(session, view), pixels, request);
}

std::shared_ptr<const LivePicture> pictureNow(const LiveSession& session) {
  LiveView view = session.view(0, std::chrono::milliseconds(0));
  if (!view.picture) throw InputError("there is no picture yet");
  return std::move(view.picture);
}

Look lookOnDisk(const LiveSession& session) { return session.readAsked({}).onDisk; }

HttpResponse strips(const LiveSession& session) {
  const Look look = lookOnDisk(session);
  return json(stripsToChoose(look.folder, stripsFolder(look)));
}

HttpResponse strip(const LiveSession& session, const HttpRequest& request) {
  const ShownPixels pixels =
      showStrip(*pictureNow(session), lookOnDisk(session), textOf(request, "name"));
  return withPixels(Json::object(), pixels, request);
}

HttpResponse probed(const LiveSession& session, const HttpRequest& request) {
  return json(probe(*pictureNow(session), numberOf(request, "x", 0), numberOf(request, "y", 0)));
}

HttpResponse kept(const StripKept& strip) {
  if (!strip.strip.empty()) return json({{"strip", strip.strip}});
  return json({{"question", strip.question}, {"freeName", strip.freeName}});
}

HttpResponse offered(const LiveSession& session, const HttpRequest& request) {
  return kept(keepStrip(lookOnDisk(session), textOf(request, "name"), request.body,
                        request.query.contains("anyway")));
}

HttpResponse painted(const LiveSession& session, const HttpRequest& request) {
  const Json wanted = Json::parse(request.body);
  const StripRecipe recipe{wanted.at("preset").get<std::string>(),
                           wanted.at("settings").get<std::vector<std::string>>()};
  if (!request.query.contains("name"))
    return withPixels(Json::object(), paintedStrip(recipe), request);
  return kept(keepPaintedStrip(lookOnDisk(session), textOf(request, "name"), recipe));
}

std::vector<std::string> overridesOf(const Json& wanted) {
  return wanted.at("overrides").get<std::vector<std::string>>();
}

HttpResponse saved(const LiveSession& session, const HttpRequest& request) {
  const Json wanted = Json::parse(request.body);
  const std::vector<std::string> overrides = overridesOf(wanted);
  const auto seen = wanted.find("onDisk");
  if (seen == wanted.end()) return json({{"before", session.save(overrides)}});
  const EntriesOnDisk entries{seen->at("style").get<std::vector<std::string>>(),
                              seen->at("light").get<std::vector<std::string>>()};
  return json({{"before", session.save(overrides, &entries)}});
}

/// The number of an input. A JSON's number may be none: negative, broken or beyond any integer.
size_t inputOf(const Json& wanted) {
  const auto given = wanted.find("input");
  if (given == wanted.end()) return 0;
  if (!given->is_number_unsigned())
    throw InputError(fmt::format("input must be a whole number from 0, but is {}",
                                 given->dump(-1, ' ', true, Json::error_handler_t::replace)));
  return given->get<size_t>();
}

HttpResponse changed(LiveSession& session, const HttpRequest& request) {
  const Json wanted = Json::parse(request.body);
  LiveChange change;
  change.overrides = overridesOf(wanted);
  change.input = inputOf(wanted);
  return json({{"change", session.change(std::move(change))}});
}

}  // namespace

HttpResponse answerPage(LiveSession& session, const HttpRequest& request) {
  try {
    if (request.method == "POST" && request.path == "/change") return changed(session, request);
    if (request.method == "POST" && request.path == "/save") return saved(session, request);
    if (request.method == "POST" && request.path == "/strip") return offered(session, request);
    if (request.method == "POST" && request.path == "/paint") return painted(session, request);
    if (request.method == "GET") {
      if (request.path == "/tables") return json(tables());
      if (request.path == "/picture") return picture(session, request);
      if (request.path == "/probe") return probed(session, request);
      if (request.path == "/strips") return strips(session);
      if (request.path == "/strip") return strip(session, request);
      if (request.path == "/paint") return json(stripKnobs());
      for (const PageFile& file : pageFiles())
        if (file.path == request.path)
          return {.type = std::string(file.type), .body = std::string(file.content)};
    }
  } catch (const Error& error) {
    return {.status = 400, .body = std::string(error.what()) + "\n"};
  } catch (const Json::exception&) {
    return {.status = 400, .body = "that is not the JSON that was expected\n"};
  }
  return {.status = 404, .body = "there is no such thing here\n"};
}

}  // namespace kagefude
