// runtime/programs/play/ui/ui.cpp: areas, tabs, splitters, and what lies over them.
#include "runtime/programs/play/ui/ui.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace kinora::play {

namespace {

enum class Scrolls {
    Inside,  // what is in the panel does
    Down,    // the panel as a whole; its texts are as wide as it is
    Both,
};

struct PanelRow {
    const char* name;  // as the command `panel` has it
    const char* title;
    Area area;
    bool at_start;  // open the first time
    Scrolls scrolls;
};
constexpr PanelRow kPanels[] = {
    {"scene", "Scene", Area::Left, true, Scrolls::Inside},
    {"parameters", "Parameters", Area::Left, true, Scrolls::Inside},
    {"lights", "Lights", Area::Left, false, Scrolls::Both},
    {"quality", "Quality", Area::Left, false, Scrolls::Both},
    {"editor", "Shader", Area::Right, true, Scrolls::Inside},
    {"pixel", "Pixel", Area::Right, true, Scrolls::Both},
    {"library", "Library", Area::Right, false, Scrolls::Inside},
    {"explained", "Explained", Area::Right, false, Scrolls::Down},
    {"source", "Source", Area::Right, false, Scrolls::Inside},
    {"findings", "Findings", Area::Bottom, false, Scrolls::Inside},
    {"times", "Frame times", Area::Bottom, false, Scrolls::Both},
};

ImGuiWindowFlags scroll_flags(Scrolls scrolls) {
    if (scrolls == Scrolls::Down) return 0;
    if (scrolls == Scrolls::Both) return ImGuiWindowFlags_HorizontalScrollbar;
    return ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
}

// Open panels without a place in an area.
constexpr const char* kOverlays[] = {"hud", "code", "keys", "commands"};

bool known(const std::string& name) {
    return std::any_of(std::begin(kPanels), std::end(kPanels),
                       [&](const PanelRow& row) { return name == row.name; }) ||
           name == kOverlays[0];
}

constexpr float kGrip = 3;           // of a splitter, to each side
constexpr float kLeastMiddle = 240;  // pixels that remain for the picture
constexpr float kNarrow = 560;       // of a window less wide, the picture has what no panel needs
constexpr float kLow = 320;          // a window less high has no status bar

}  // namespace

Ui::Ui(Player& player, const Layout& layout, float scale, bool follow_size)
    : layout_(layout),
      theme_(make_theme(scale)),
      context_(player, theme_, layout_),
      editor_(theme_.editor),
      viewport_(follow_size) {
    ImGui::GetIO().IniFilename = nullptr;
    take_fonts();
    restore_panels();
}

void Ui::take_fonts() {
    ImGuiIO& io = ImGui::GetIO();
    unsigned char* texels;
    io.Fonts->GetTexDataAsAlpha8(&texels, &font_.width, &font_.height);
    font_.texels = texels;
    font_.format = TexelFormat::Alpha8;
    io.Fonts->SetTexID(texture_id(&font_));
    io.FontDefault = theme_.fonts.text;
}

// Between two frames: fonts with the letters that names and texts have by now.
void Ui::follow_letters() {
    const auto scene = context_.player.scene();
    const ShaderDocument& shader = context_.player.shader();
    bool some = std::exchange(typed_some_, false);
    if (scene && scene->serial != lettered_scene_) {
        lettered_scene_ = scene->serial;
        some |= letters_.add(scene->path);
        for (const auto* names : {&scene->cameras, &scene->lights})
            for (const std::string& name : *names) some |= letters_.add(name);
        for (const ClipInfo& clip : scene->clips) some |= letters_.add(clip.name);
        for (const NodeInfo& node : scene->nodes) some |= letters_.add(node.name);
        for (const MaterialInfo& material : scene->materials) some |= letters_.add(material.name);
    }
    if (shader.version != lettered_text_ || shader.material != lettered_material_) {
        lettered_text_ = shader.version;
        lettered_material_ = shader.material;
        some |= letters_.add(shader.text);
    }
    const auto& findings = context_.player.findings();
    if (findings.size() != lettered_findings_) {
        lettered_findings_ = findings.size();
        for (const FindingText& finding : findings) some |= letters_.add(finding.message);
    }
    if (!some) return;
    theme_.fonts = load_fonts(theme_.scale, letters_);
    take_fonts();
}

void Ui::restore_panels() {
    if (!Context::has("panel")) return;
    for (const PanelRow& row : kPanels) {
        const bool wanted = layout_.has_panels
                                ? std::find(layout_.panels.begin(), layout_.panels.end(),
                                            row.name) != layout_.panels.end()
                                : row.at_start;
        if (wanted != context_.open(row.name)) context_.toggle(row.name);
    }
    const bool hud = !layout_.has_panels || std::find(layout_.panels.begin(), layout_.panels.end(),
                                                      "hud") != layout_.panels.end();
    if (hud != context_.open("hud")) context_.toggle("hud");
    context_.toast = {};
}

void Ui::remember_panels() {
    layout_.has_panels = true;
    layout_.panels.clear();
    for (const std::string& panel : context_.state().panels)
        if (known(panel)) layout_.panels.push_back(panel);
}

bool Ui::shows(Area area) const {
    return std::any_of(std::begin(kPanels), std::end(kPanels), [&](const PanelRow& row) {
        return row.area == area && context_.open(row.name);
    });
}

// In a narrow window one side is shown: the one of the panel opened last, none at first.
void Ui::follow_opened() {
    const RaisedPanel& raised = context_.state().raised;
    const bool raises = std::exchange(raised_, raised.times) != raised.times && followed_;
    if (raises) context_.to_front = raised.name;
    std::vector<std::string> open;
    for (const PanelRow& row : kPanels)
        if (context_.open(row.name)) open.push_back(row.name);
    for (const PanelRow& row : kPanels) {
        const bool before = std::find(opened_.begin(), opened_.end(), row.name) != opened_.end();
        const bool comes = !before || (raises && raised.name == row.name);
        if (!followed_ || !comes || !context_.open(row.name)) continue;
        if (context_.to_front.empty()) context_.to_front = row.name;
        if (row.area != Area::Bottom) narrow_side_ = row.area;
    }
    if (narrow_side_ && !shows(*narrow_side_)) narrow_side_.reset();
    opened_ = std::move(open);
    followed_ = true;
}

void Ui::draw_panel(const char* name) {
    const std::string_view panel = name;
    if (panel == "scene") nodes_.draw(context_);
    if (panel == "parameters") draw_parameters(context_);
    if (panel == "lights") draw_lights(context_);
    if (panel == "quality") draw_quality(context_);
    if (panel == "explained") draw_explained(context_);
    if (panel == "library") library_.draw(context_);
    if (panel == "editor") editor_.draw(context_);
    if (panel == "pixel") draw_pixel(context_);
    if (panel == "source") source_.draw(context_);
    if (panel == "findings") draw_findings(context_);
    if (panel == "times") draw_times(context_);
}

void Ui::draw_area(Area area, const Box& box) {
    constexpr const char* kNames[kAreaCount] = {"##left", "##right", "##bottom"};
    ImGui::SetCursorScreenPos(box.low);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme_.px(8), theme_.px(6)});
    ImGui::BeginChild(kNames[static_cast<size_t>(area)], box.size(), false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar);
    ImGui::PopStyleVar();
    std::string& front = layout_.front[static_cast<size_t>(area)];
    if (ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyResizeDown)) {
        for (const PanelRow& row : kPanels) {
            if (row.area != area || !context_.open(row.name)) continue;
            bool stays = true;
            const bool asked = context_.to_front == row.name ||
                               (!front.empty() && front == row.name && ImGui::GetFrameCount() < 3);
            std::string title = row.title;
            if (std::string_view(row.name) == "findings") {
                const size_t count = context_.player.findings().size();
                if (count) title += fmt::format(" ({})", count);
            }
            title += fmt::format("###{}", row.name);
            if (ImGui::BeginTabItem(title.c_str(), &stays,
                                    asked ? ImGuiTabItemFlags_SetSelected : 0)) {
                if (ImGui::GetFrameCount() >= 3) front = row.name;
                ImGui::BeginChild(row.name, {0, 0}, false, scroll_flags(row.scrolls));
                draw_panel(row.name);
                ImGui::EndChild();
                ImGui::EndTabItem();
            }
            if (asked && context_.to_front == row.name) context_.to_front.clear();
            if (!stays) context_.toggle(row.name);
        }
        ImGui::EndTabBar();
    }
    ImGui::EndChild();
}

void Ui::splitter(Area area, const Box& box) {
    constexpr const char* kNames[kAreaCount] = {"##split_left", "##split_right", "##split_bottom"};
    const size_t index = static_cast<size_t>(area);
    const float grip = theme_.px(kGrip);
    const bool upright = area != Area::Bottom;
    ImGui::SetCursorScreenPos(upright ? ImVec2{box.low.x - grip, box.low.y}
                                      : ImVec2{box.low.x, box.low.y - grip});
    ImGui::InvisibleButton(kNames[index], upright ? ImVec2{2 * grip + 1, box.size().y}
                                                  : ImVec2{box.size().x, 2 * grip + 1});
    const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (lit) ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    // The way to where the button went down may belong to the same turn.
    if (ImGui::IsItemActive() && !ImGui::IsItemActivated()) {
        const ImVec2 moved = ImGui::GetIO().MouseDelta;
        const float by = area == Area::Left ? moved.x : area == Area::Right ? -moved.x : -moved.y;
        layout_.sizes[index] = std::clamp(layout_.sizes[index] + by / theme_.scale, 80.0f, 4096.0f);
    }
    const float thick = lit ? 1.5f : 0.5f;
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 color = lit ? theme_.accent : IM_COL32(10, 11, 12, 255);
    if (upright)
        list->AddRectFilled({box.low.x - thick, box.low.y}, {box.low.x + thick, box.high.y}, color);
    else
        list->AddRectFilled({box.low.x, box.low.y - thick}, {box.high.x, box.low.y + thick}, color);
}

// How many errors and warnings there are; a click lists them.
void Ui::tell_findings(float x, const Box& box) {
    size_t errors = 0, warnings = 0;
    for (const FindingText& finding : context_.player.findings()) {
        errors += finding.severity == "error";
        warnings += finding.severity == "warning";
    }
    std::string text;
    const auto add = [&](size_t count, const char* what) {
        if (count)
            text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", count, what,
                                count == 1 ? "" : "s");
    };
    add(errors, "error");
    add(warnings, "warning");
    if (text.empty()) return;
    const ImU32 color = errors ? theme_.error : theme_.warning;
    const float middle = std::round((box.low.y + box.high.y) / 2), r = theme_.px(4);
    ImGui::SetCursorScreenPos({x, box.low.y});
    if (ImGui::InvisibleButton("##told",
                               {ImGui::CalcTextSize(text.c_str()).x + 4 * r, box.size().y}))
        context_.show("findings");
    command_tooltip("show_findings");
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddCircleFilled({x + r, middle}, r, color, 16);
    list->AddText({x + 3 * r, std::round(middle - ImGui::GetFontSize() / 2)}, color, text.c_str());
}

void Ui::status_bar(const Box& box) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(box.low, box.high, IM_COL32(0x1a, 0x1b, 0x1e, 255));
    const float y = std::round(box.low.y + (box.size().y - ImGui::GetFontSize()) / 2);
    const PlayerState& state = context_.state();
    std::string left = "no scene";
    if (const auto scene = context_.player.scene()) {
        left = scene->path.substr(scene->path.rfind('/') + 1);
        if (!state.camera.free && state.camera.index < scene->cameras.size())
            left += "   camera: " + scene->cameras[state.camera.index];
        if (state.camera.free) left += "   free camera";
        if (!state.selection.node.empty())
            left += "   " + state.selection.node.substr(state.selection.node.rfind('/') + 1);
    }
    list->AddText({box.low.x + theme_.px(12), y}, theme_.dim, left.c_str());
    tell_findings(box.low.x + theme_.px(28) + ImGui::CalcTextSize(left.c_str()).x, box);
    const std::string& value = viewport_.under_pointer();
    if (!value.empty()) {
        ImFont* mono = theme_.fonts.mono;
        const float size = ImGui::GetFontSize() * 0.93f,
                    width = mono->CalcTextSizeA(size, 1e9f, 0, value.c_str()).x;
        list->AddText(mono, size, {box.high.x - width - theme_.px(12), y}, theme_.text,
                      value.c_str());
    }
}

void Ui::draw_toast(const Box& box) {
    const Toast& toast = context_.toast;
    if (toast.text.empty() || ImGui::GetTime() >= toast.until) return;
    ImDrawList* list = ImGui::GetForegroundDrawList();
    const float most = std::max(theme_.px(120), box.size().x - theme_.px(60));
    const ImVec2 extent = ImGui::CalcTextSize(toast.text.c_str(), nullptr, false, most);
    const ImVec2 at{std::round((box.low.x + box.high.x - extent.x) / 2),
                    std::round(box.high.y - extent.y - theme_.px(26))};
    const float x = theme_.px(14), y = theme_.px(8);
    list->AddRectFilled({at.x - x, at.y - y}, {at.x + extent.x + x, at.y + extent.y + y},
                        IM_COL32(0x2c, 0x2f, 0x35, 245), theme_.px(6));
    list->AddRectFilled({at.x - x, at.y - y}, {at.x - x + theme_.px(3), at.y + extent.y + y},
                        toast.fault ? theme_.error : theme_.accent, theme_.px(2));
    list->AddText(nullptr, 0, at, theme_.text, toast.text.c_str(), nullptr, most);
}

void Ui::draw() {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(display);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("##window", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_MenuBar | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    draw_menu(context_);
    follow_opened();
    const bool narrow = display.x < theme_.px(kNarrow), is_low = display.y < theme_.px(kLow);
    const float top = ImGui::GetFrameHeight(), status = is_low ? 0.0f : theme_.px(24),
                transport = timeline_.height(theme_);
    const auto size_of = [&](Area area, float most) {
        const bool hidden = narrow && area != Area::Bottom && narrow_side_ != area;
        return shows(area) && !hidden
                   ? std::round(std::clamp(theme_.px(layout_.sizes[static_cast<size_t>(area)]),
                                           theme_.px(80), std::max(theme_.px(80), most)))
                   : 0.0f;
    };
    const float right = size_of(Area::Right, display.x * (narrow ? 0.8f : 0.6f));
    const float left = size_of(
        Area::Left, narrow ? display.x * 0.8f : display.x - right - theme_.px(kLeastMiddle));
    const float bottom = size_of(Area::Bottom, display.y * 0.5f);
    const float low = display.y - status, middle = low - transport - bottom;
    const float grip = theme_.px(kGrip);
    const Box left_box{{0, top}, {left - grip, low}},
        right_box{{display.x - right + grip, top}, {display.x, low}};
    const Box picture{{left, top}, {display.x - right, middle}};
    const Box time_box{{left, middle}, {display.x - right, middle + transport}};
    const Box bottom_box{{left, middle + transport + grip}, {display.x - right, low}};

    // First: the item that comes first has the pointer.
    if (left > 0) splitter(Area::Left, {{left, top}, {left, low}});
    if (right > 0) splitter(Area::Right, {{display.x - right, top}, {display.x - right, low}});
    if (bottom > 0)
        splitter(Area::Bottom, {{left, bottom_box.low.y}, {display.x - right, bottom_box.low.y}});
    viewport_.draw(context_, picture.low, picture.size());
    ImGui::SetCursorScreenPos(time_box.low);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme_.px(10), theme_.px(5)});
    ImGui::BeginChild("##time", time_box.size(), false,
                      ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar |
                          ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    timeline_.draw(context_);
    ImGui::EndChild();
    if (left > 0) draw_area(Area::Left, left_box);
    if (right > 0) draw_area(Area::Right, right_box);
    if (bottom > 0) draw_area(Area::Bottom, bottom_box);
    if (!context_.open("editor")) editor_.release();
    if (!is_low) status_bar({{0, low}, {display.x, display.y}});
    ImGui::End();

    // The palette is a panel of the state, which it leaves by itself.
    const bool wanted = context_.open("commands");
    palette_.draw(context_, wanted);
    if (wanted && !palette_.open() && context_.open("commands")) context_.toggle("commands");
    if (context_.open("keys")) draw_cheat_sheet(context_);
    draw_toast(picture);
    remember_panels();
    // Why a scene could not be opened is said without being asked for.
    const bool failed = context_.player.load_state() == LoadState::Failed;
    if (failed && !failed_) context_.show("findings");
    failed_ = failed;
}

void Ui::render(const Target& target, float seconds) {
    ImGui::GetIO().DeltaTime = std::max(seconds, 1e-4f);
    follow_letters();
    ImGui::NewFrame();
    draw();
    ImGui::Render();
    play::draw(*ImGui::GetDrawData(), target);
}

bool Ui::wants_text() const {
    return ImGui::GetIO().WantTextInput || editor_.focused() || palette_.open();
}

bool Ui::press(const std::string& key) {
    const bool combined = key.starts_with("Ctrl+") || key.starts_with("Alt+");
    const bool function =
        key.size() > 1 && key[0] == 'F' && std::isdigit(static_cast<unsigned char>(key[1]));
    if (wants_text() && !combined && !function) return false;
    // What the editor does itself: it sends the text that results.
    constexpr const char* kOfText[] = {"Ctrl+Z",     "Ctrl+Shift+Z", "Ctrl+Y",  "Ctrl+A",
                                       "Ctrl+C",     "Ctrl+X",       "Ctrl+V",  "Ctrl+Left",
                                       "Ctrl+Right", "Ctrl+Home",    "Ctrl+End"};
    if (wants_text() && std::find(std::begin(kOfText), std::end(kOfText), key) != std::end(kOfText))
        return false;
    if (viewport_.may_fly() && !combined) return false;  // W A S D Q E
    const Command* command = find_command_of_key(key);
    if (!command) return false;
    if (*command->arguments && command->arguments[0] != '[') {
        context_.ask(*command);
    } else {
        context_.run(command->word);
    }
    return true;
}

double Ui::next_turn() const {
    double next = viewport_.next_turn();
    const double toast = context_.toast.text.empty() ? -1 : context_.toast.until - ImGui::GetTime();
    if (toast > 0 && (next < 0 || toast < next)) next = toast;
    return next;
}

}  // namespace kinora::play
