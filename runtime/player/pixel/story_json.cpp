// runtime/player/pixel/story_json.cpp: a story as JSON, for scripts. Numbers that are not finite
// are texts, since JSON has none.
#include <fmt/format.h>

#include <cmath>

#include "runtime/player/pixel/pixel_story.h"

namespace kinora {

std::string json_text(std::string_view text) {
    std::string out = "\"";
    for (char c : text)
        if (c == '"' || c == '\\')
            out += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20)
            out += fmt::format("\\u{:04x}", c);
        else
            out += c;
    return out + '"';
}

namespace {

std::string number_text(float x) {
    return std::isfinite(x) ? fmt::format("{}", x) : fmt::format("\"{}\"", x);
}

// "[a, b]" of what text(item) gives.
template <class List, class Text>
std::string list_text(const List& list, Text&& text, const char* between = ", ") {
    std::string out = "[";
    for (const auto& item : list) out += (out.size() > 1 ? between : "") + text(item);
    return out + "]";
}

std::string numbers_text(std::span<const float> numbers) {
    return list_text(numbers, number_text);
}

std::string variable_text(const StoryVariable& v) {
    return fmt::format(R"({{"name": {}, "type": "{}", "rate": "{}", "nan": {}, "value": {}}})",
                       json_text(v.name), v.type, v.varying ? "varying" : "uniform", v.nan,
                       v.text ? list_text(v.texts, json_text) : numbers_text(v.values));
}

std::string step_text(const StoryStep& s) {
    return fmt::format(
        "\n   {{\"inside\": {}, \"file\": {}, \"line\": {}, \"source\": {}, \"turns\": {}, "
        "\"light\": {},\n    \"changes\": {}}}",
        json_text(s.inside), json_text(s.file), s.line, json_text(s.source),
        list_text(s.turns, [](int32_t turn) { return std::to_string(turn); }), json_text(s.light),
        list_text(s.changes, variable_text, ",\n     "));
}

std::string run_text(const MachineRun& run) {
    return fmt::format("\n    {{\"file\": {}, \"line\": {}, \"code\": {}}}", json_text(run.file),
                       run.line, list_text(run.instructions, json_text));
}

std::string ray_json(const StoryRay& ray) {
    auto place = [](dvec3 p) { return fmt::format("[{}, {}, {}]", p.x, p.y, p.z); };
    return fmt::format("\n  {{\"kind\": \"{}\", \"from\": {}, \"to\": {}, \"hit\": {}}}",
                       ray_text(ray.kind), place(ray.from), place(ray.to), ray.hit);
}

std::string point_text(const PointStory& p) {
    return fmt::format(
        "\n  {{\"material\": {}, \"shader\": {}, \"agreement\": \"{}\", \"why\": {},\n"
        "   \"Ci\": {}, \"Oi\": {}, \"reference_Ci\": {}, \"allowed\": {},\n"
        "   \"nan\": {{\"file\": {}, \"line\": {}, \"column\": {}}}, \"cut\": {}, \"steps\": {},\n"
        "   \"target\": \"{}\", \"no_code\": {}, \"code\": {}}}",
        json_text(p.material), json_text(p.shader), agreement_text(p.agreement), json_text(p.why),
        numbers_text(p.Ci), numbers_text(p.Oi), numbers_text(p.reference_Ci),
        numbers_text(p.allowed), json_text(p.nan_file), p.nan_line, p.nan_column, p.cut,
        list_text(p.steps, step_text, ","), p.target, json_text(p.no_code),
        list_text(p.code, run_text, ","));
}

}  // namespace

std::string to_json(const PixelStory& story) {
    const vec4& c = story.color;
    return fmt::format(
        "{{\"pixel\": [{}, {}], \"sample\": {}, \"frame\": {}, \"color\": [{}, {}, {}, {}],\n"
        " \"points\": {},\n \"rays\": {}, \"rays_cut\": {}}}\n",
        story.x, story.y, story.sample, story.frame, number_text(c.x), number_text(c.y),
        number_text(c.z), number_text(c.w), list_text(story.points, point_text, ","),
        list_text(story.rays, ray_json, ","), story.rays_cut);
}

}  // namespace kinora
