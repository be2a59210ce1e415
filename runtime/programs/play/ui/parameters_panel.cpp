// runtime/programs/play/ui/parameters_panel.cpp: materials, and widgets by declared types.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <vector>

#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

namespace {

const char* type_name(ParamKind kind) {
    switch (kind) {
        case ParamKind::Float:
            return "float";
        case ParamKind::Color:
            return "color";
        case ParamKind::Point:
            return "point";
        case ParamKind::Vector:
            return "vector";
        case ParamKind::Normal:
            return "normal";
        case ParamKind::Matrix:
            return "matrix";
        case ParamKind::Text:
            return "string";
    }
    return "";
}

size_t components(ParamKind kind) {
    switch (kind) {
        case ParamKind::Float:
            return 1;
        case ParamKind::Matrix:
            return 16;
        case ParamKind::Text:
            return 0;
        case ParamKind::Color:
        case ParamKind::Point:
        case ParamKind::Vector:
        case ParamKind::Normal:
            return 3;
    }
    return 0;
}

constexpr float kThreeNumbers = 170;

// The numbers of one element, changed in place. A step of a drag is a share of the number.
bool edit_numbers(const Theme& theme, ParamKind kind, double* numbers) {
    const float width = ImGui::GetContentRegionAvail().x - theme.px(4);
    ImGui::SetNextItemWidth(width);
    float values[16];
    const size_t count = components(kind);
    float largest = 0;
    for (size_t i = 0; i < count; ++i) {
        values[i] = static_cast<float>(numbers[i]);
        largest = std::max(largest, std::abs(values[i]));
    }
    const float speed = std::max(0.002f, largest * 0.005f);
    bool changed = false;
    if (kind == ParamKind::Color) {
        // Where three numbers have no room, the color alone; a click on it shows them.
        const bool has_room = width >= theme.px(kThreeNumbers);
        changed = ImGui::ColorEdit3("##value", values,
                                    ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR |
                                        (has_room ? 0 : ImGuiColorEditFlags_NoInputs));
    } else if (kind == ParamKind::Matrix) {
        for (int row = 0; row < 4; ++row) {
            ImGui::PushID(row);
            ImGui::SetNextItemWidth(width);
            changed |= ImGui::DragFloat4("##row", values + 4 * row, speed, 0, 0, "%.3g");
            ImGui::PopID();
        }
    } else if (count == 1) {
        changed = ImGui::DragFloat("##value", values, speed, 0, 0, "%.4g");
    } else {
        changed = ImGui::DragFloat3("##value", values, speed, 0, 0, "%.4g");
    }
    if (changed)
        for (size_t i = 0; i < count; ++i) numbers[i] = static_cast<double>(values[i]);
    return changed;
}

std::string numbers_text(const std::vector<double>& numbers) {
    std::string text;
    for (double number : numbers) text += fmt::format("{}{:.7g}", text.empty() ? "" : " ", number);
    return text;
}

void draw_value(Context& context, const ShaderParamInfo& param) {
    if (param.kind == ParamKind::Text) {
        std::string text = param.text;
        ImGui::SetNextItemWidth(-1);
        if (ImGui::InputText("##text", &text, ImGuiInputTextFlags_EnterReturnsTrue))
            context.run("param", {param.name, text});
        return;
    }
    if (param.numbers.empty()) {
        ImGui::TextDisabled("differs from point to point");
        return;
    }
    std::vector<double> numbers = param.numbers;
    const size_t step = components(param.kind);
    bool changed = false;
    for (size_t at = 0; at + step <= numbers.size(); at += step) {
        ImGui::PushID(static_cast<int>(at));
        changed |= edit_numbers(context.theme, param.kind, numbers.data() + at);
        ImGui::PopID();
    }
    if (!changed) return;
    std::vector<std::string> words{param.name, numbers_text(numbers)};
    if (context.dragged == param.name) words.emplace_back("further");
    context.dragged = param.name;
    context.run("param", words);
}

constexpr ImU32 kCurveColors[] = {IM_COL32(0xe0, 0x6c, 0x60, 255), IM_COL32(0x7f, 0xc0, 0x6a, 255),
                                  IM_COL32(0x5f, 0x9c, 0xe8, 255)};

// A line for each of its numbers over the scene's range, all of one scale, and where time stands.
void draw_curve(Context& context, const ShaderParamInfo& param, const SceneInfo& scene) {
    const size_t numbers = param.curve.size() / kCurvePoints;
    if (numbers == 0) return;
    const Theme& theme = context.theme;
    const auto [least, most] = std::minmax_element(param.curve.begin(), param.curve.end());
    const float low = *least, range = *most > low ? *most - low : 1.0f;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(ImGui::GetContentRegionAvail().x, 8.0f), theme.px(34)};
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, IM_COL32(0, 0, 0, 70),
                        theme.px(3));
    std::vector<ImVec2> line(kCurvePoints);
    for (size_t c = 0; c < numbers; ++c) {
        for (size_t k = 0; k < kCurvePoints; ++k) {
            const float x = static_cast<float>(k) / static_cast<float>(kCurvePoints - 1),
                        y = (param.curve[k * numbers + c] - low) / range;
            line[k] = {corner.x + x * size.x, corner.y + size.y - 2 - y * (size.y - 4)};
        }
        list->AddPolyline(line.data(), static_cast<int>(line.size()),
                          numbers == 1 ? theme.accent : kCurveColors[c % 3], 0, 1.2f);
    }
    const double length = std::max(scene.last - scene.first, 1e-9),
                 at = (context.state().time.frame - scene.first) / length;
    const float x = corner.x + static_cast<float>(std::clamp(at, 0.0, 1.0)) * size.x;
    list->AddRectFilled({x, corner.y}, {x + 1, corner.y + size.y}, theme.text);
    ImGui::Dummy(size);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%.4g to %.4g, from frame %g to %g", static_cast<double>(*least),
                          static_cast<double>(*most), scene.first, scene.last);
}

void draw_parameter(Context& context, const ShaderParamInfo& param, const SceneInfo& scene) {
    const Theme& theme = context.theme;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, param.changed ? theme.accent : theme.text);
    ImGui::TextUnformatted(param.name.c_str());
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s%s%s %s%s", param.output ? "output " : "",
                          param.varying ? "varying " : "", type_name(param.kind),
                          param.name.c_str(), param.changed ? "\nchanged by hand" : "");
    ImGui::TableNextColumn();
    const bool fixed = param.animated || !Context::has("param");
    if (param.animated) {
        ImGui::PushStyleColor(ImGuiCol_Text, theme.accent);
        ImGui::TextUnformatted("animated");
        ImGui::PopStyleColor();
    }
    ImGui::BeginDisabled(fixed);
    draw_value(context, param);
    ImGui::EndDisabled();
    draw_curve(context, param, scene);
}

void draw_materials(Context& context, const SceneInfo& scene) {
    const std::string& current = context.state().selection.material;
    const Theme& theme = context.theme;
    const float row = ImGui::GetTextLineHeightWithSpacing();
    // Those of the defaults have no name.
    const auto named =
        std::count_if(scene.materials.begin(), scene.materials.end(),
                      [](const MaterialInfo& material) { return !material.id.empty(); });
    const auto shown = static_cast<float>(std::min<long>(named, 7));
    ImGui::BeginChild("materials", {0, row * shown + theme.px(4)});
    for (const MaterialInfo& material : scene.materials) {
        if (material.id.empty()) continue;
        ImGui::PushID(material.id.c_str());
        if (ImGui::Selectable("##material", material.id == current) &&
            context.has("select_material"))
            context.run("select_material", {material.id});
        ImGui::SameLine(theme.px(6));
        ImGui::PushStyleColor(ImGuiCol_Text, material.further ? theme.dim : theme.text);
        ImGui::TextUnformatted((material.name.empty() ? material.id : material.name).c_str());
        ImGui::PopStyleColor();
        const float right = ImGui::GetContentRegionAvail().x;
        const float width = ImGui::CalcTextSize(material.shader.c_str()).x;
        ImGui::SameLine(
            std::max(ImGui::GetCursorPosX() + right - width - theme.px(6), theme.px(90)));
        ImGui::TextDisabled("%s", material.shader.c_str());
        ImGui::PopID();
    }
    ImGui::EndChild();
    ImGui::Separator();
}

}  // namespace

void draw_parameters(Context& context) {
    const auto scene = context.player.scene();
    if (!scene) return empty_note(context.theme, "No scene is open.");
    if (!ImGui::IsAnyItemActive()) context.dragged.clear();  // the button came up
    draw_materials(context, *scene);
    const ShaderDocument& shader = context.player.shader();
    if (shader.material.empty())
        return empty_note(context.theme, "Choose a material to see its parameters.");
    if (shader.params.empty()) return empty_note(context.theme, "This shader has no parameters.");
    ImGui::BeginChild("parameters");
    if (ImGui::BeginTable("parameters", 2, ImGuiTableFlags_SizingStretchProp)) {
        ImGui::TableSetupColumn("name", 0, 0.38f);
        ImGui::TableSetupColumn("value", 0, 0.62f);
        for (const ShaderParamInfo& param : shader.params) {
            ImGui::PushID(param.name.c_str());
            draw_parameter(context, param, *scene);
            ImGui::PopID();
        }
        ImGui::EndTable();
    }
    ImGui::EndChild();
}

}  // namespace kinora::play
