#include "live/live_page.h"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "live/probe.h"
#include "live/show_stage.h"
#include "live/strip_choice.h"
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

/// A query's number, or what stands for none. Throws InputError.
template <class Number>
Number numberOf(const HttpRequest& request, const std::string& name, Number otherwise) {
  const auto given = request.query.find(name);
  if (given == request.query.end()) return otherwise;
  const std::string& text = given->second;
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw InputError(fmt::format("{} must be a number", name));
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
  state["onDisk"] = {{"style", view.stylesOnDisk}, {"light", view.lightsOnDisk}};
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

/// What the page reads pixels from: the length of the state, the state, the pixels.
HttpResponse withPixels(const Json& state, const ShownPixels& pixels) {
  const std::string text = state.dump(-1, ' ', true, Json::error_handler_t::replace);
  HttpResponse response{.type = "application/octet-stream"};
  addLength(response.body, text.size());
  response.body += text;
  response.body += pixels.bytes;
  return response;
}

HttpResponse picture(const LiveSession& session, const HttpRequest& request) {
  const auto seen = numberOf<uint64_t>(request, "seen", 0);
  const Viewing viewing{numberOf<float>(request, "exposure", 0), textOf(request, "display"),
                        textOf(request, "view")};
  const LiveView view = session.view(seen, longestPoll);
  Json state = describe(session, view);
  ShownPixels pixels;
  if (view.version > seen && view.picture) {
    pixels = showStage(*view.picture, textOf(request, "stage", "result"), viewing);
    state["size"] = {pixels.width, pixels.height};
  }
  return withPixels(state, pixels);
}

std::shared_ptr<const LivePicture> pictureNow(const LiveSession& session) {
  LiveView view = session.view(0, std::chrono::milliseconds(0));
  if (!view.picture) throw InputError("there is no picture yet");
  return std::move(view.picture);
}

HttpResponse strips(const LiveSession& session) {
  return json(stripsToChoose(session.settings().look.parent_path()));
}

HttpResponse strip(const LiveSession& session, const HttpRequest& request) {
  const ShownPixels pixels =
      showStrip(*pictureNow(session), session.readAsked({}).onDisk, textOf(request, "name"));
  return withPixels({{"size", {pixels.width, pixels.height}}}, pixels);
}

HttpResponse probed(const LiveSession& session, const HttpRequest& request) {
  return json(probe(*pictureNow(session), numberOf(request, "x", 0), numberOf(request, "y", 0)));
}

std::vector<std::string> overridesOf(const Json& wanted) {
  return wanted.at("overrides").get<std::vector<std::string>>();
}

HttpResponse saved(const LiveSession& session, const HttpRequest& request) {
  return json({{"before", session.save(overridesOf(Json::parse(request.body)))}});
}

HttpResponse changed(LiveSession& session, const HttpRequest& request) {
  const Json wanted = Json::parse(request.body);
  LiveChange change;
  change.overrides = overridesOf(wanted);
  change.input = wanted.value("input", size_t{0});
  return json({{"change", session.change(std::move(change))}});
}

}  // namespace

HttpResponse answerPage(LiveSession& session, const HttpRequest& request) {
  try {
    if (request.method == "POST" && request.path == "/change") return changed(session, request);
    if (request.method == "POST" && request.path == "/save") return saved(session, request);
    if (request.method == "GET") {
      if (request.path == "/tables") return json(tables());
      if (request.path == "/picture") return picture(session, request);
      if (request.path == "/probe") return probed(session, request);
      if (request.path == "/strips") return strips(session);
      if (request.path == "/strip") return strip(session, request);
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
