// runtime/programs/play/ui/theme.cpp: a dark grey room with one warm light.
#include "runtime/programs/play/ui/theme.h"

#include "runtime/programs/play/ui/letters.h"

namespace kinora::play {

namespace {

constexpr ImU32 rgb(uint32_t hex, uint32_t alpha = 255) {
    return IM_COL32(hex >> 16, hex >> 8 & 255, hex & 255, alpha);
}

ImVec4 color(uint32_t hex, uint32_t alpha = 255) {
    return ImGui::ColorConvertU32ToFloat4(rgb(hex, alpha));
}

constexpr uint32_t kText = 0xdcdde1, kDim = 0x8f939c, kFaint = 0x5d616b, kAccent = 0xf0a94b;
constexpr uint32_t kStage = 0x141517, kPanel = 0x202226, kRaised = 0x2c2f35, kLine = 0x383b42;

struct StyleRow {
    ImGuiCol which;
    uint32_t hex, alpha;
};
constexpr StyleRow kStyle[] = {
    {ImGuiCol_Text, kText, 255},
    {ImGuiCol_TextDisabled, kDim, 255},
    {ImGuiCol_WindowBg, kPanel, 255},
    {ImGuiCol_ChildBg, kPanel, 0},
    {ImGuiCol_PopupBg, 0x26292e, 252},
    {ImGuiCol_Border, kLine, 255},
    {ImGuiCol_FrameBg, 0x17181b, 255},
    {ImGuiCol_FrameBgHovered, 0x1c1e22, 255},
    {ImGuiCol_FrameBgActive, 0x121316, 255},
    {ImGuiCol_MenuBarBg, 0x1a1b1e, 255},
    {ImGuiCol_ScrollbarBg, kPanel, 0},
    {ImGuiCol_ScrollbarGrab, 0x3e424a, 255},
    {ImGuiCol_ScrollbarGrabHovered, 0x4d525c, 255},
    {ImGuiCol_ScrollbarGrabActive, 0x5d636f, 255},
    {ImGuiCol_CheckMark, kAccent, 255},
    {ImGuiCol_SliderGrab, kAccent, 200},
    {ImGuiCol_SliderGrabActive, kAccent, 255},
    {ImGuiCol_Button, kRaised, 255},
    {ImGuiCol_ButtonHovered, 0x383c44, 255},
    {ImGuiCol_ButtonActive, 0x454a54, 255},
    {ImGuiCol_Header, 0x4a3b25, 255},
    {ImGuiCol_HeaderHovered, 0x33363d, 255},
    {ImGuiCol_HeaderActive, 0x574429, 255},
    {ImGuiCol_Separator, kLine, 255},
    {ImGuiCol_SeparatorHovered, kAccent, 160},
    {ImGuiCol_SeparatorActive, kAccent, 255},
    {ImGuiCol_ResizeGrip, kLine, 0},
    {ImGuiCol_ResizeGripHovered, kAccent, 120},
    {ImGuiCol_ResizeGripActive, kAccent, 200},
    {ImGuiCol_Tab, kPanel, 255},
    {ImGuiCol_TabHovered, 0x383c44, 255},
    {ImGuiCol_TabActive, kRaised, 255},
    {ImGuiCol_TabUnfocused, kPanel, 255},
    {ImGuiCol_TabUnfocusedActive, kRaised, 255},
    {ImGuiCol_TableHeaderBg, kPanel, 255},
    {ImGuiCol_TableBorderStrong, kLine, 255},
    {ImGuiCol_TableBorderLight, kLine, 110},
    {ImGuiCol_TableRowBg, kPanel, 0},
    {ImGuiCol_TableRowBgAlt, 0xffffff, 5},
    {ImGuiCol_TextSelectedBg, kAccent, 80},
    {ImGuiCol_PlotHistogram, kAccent, 255},
    {ImGuiCol_NavHighlight, kAccent, 255},
    {ImGuiCol_ModalWindowDimBg, 0x000000, 120},
};

EditorColors editor_colors() {
    EditorColors colors;
    const auto ink = [&](Ink which, uint32_t hex) {
        colors.ink[static_cast<size_t>(which)] = rgb(hex);
    };
    ink(Ink::Plain, kText);
    ink(Ink::Comment, 0x74797f);
    ink(Ink::Directive, 0xb69ad6);
    ink(Ink::Keyword, 0xf0a94b);
    ink(Ink::Type, 0x6fb7d6);
    ink(Ink::Builtin, 0x8fcf9c);
    ink(Ink::Global, 0xe58f7b);
    ink(Ink::Number, 0xd9c27a);
    ink(Ink::String, 0xb5c98a);
    colors.background = rgb(0x17181b);
    colors.gutter = rgb(0x1b1c20);
    colors.line_number = rgb(0x666b76);
    colors.current_line = rgb(0xffffff, 10);
    colors.selection = rgb(0x4d5f86, 150);
    colors.caret = rgb(0xffd08a);
    colors.error = rgb(0xff6b5e);
    colors.warning = rgb(0xe8c14d);
    colors.popup = rgb(0x26292e, 250);
    colors.popup_selected = rgb(0x4a3b25);
    return colors;
}

}  // namespace

Theme make_theme(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowPadding = {10, 8};
    style.FramePadding = {8, 4};
    style.CellPadding = {6, 3};
    style.ItemSpacing = {8, 5};
    style.ItemInnerSpacing = {6, 4};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 11;
    style.GrabMinSize = 9;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = 0;
    style.TabBorderSize = 0;
    style.WindowRounding = 0;
    style.ChildRounding = 0;
    style.PopupRounding = 5;
    style.FrameRounding = 4;
    style.GrabRounding = 3;
    style.ScrollbarRounding = 6;
    style.TabRounding = 4;
    style.AntiAliasedLinesUseTex = false;
    style.ScaleAllSizes(scale);
    for (const StyleRow& row : kStyle) style.Colors[row.which] = color(row.hex, row.alpha);

    Theme theme;
    theme.scale = scale;
    theme.fonts = load_fonts(scale, {});
    theme.text = rgb(kText);
    theme.dim = rgb(kDim);
    theme.faint = rgb(kFaint);
    theme.accent = rgb(kAccent);
    theme.good = rgb(0x8fcf9c);
    theme.warning = rgb(0xe8c14d);
    theme.error = rgb(0xff6b5e);
    theme.stage = rgb(kStage);
    theme.panel = rgb(kPanel);
    theme.raised = rgb(kRaised);
    theme.line = rgb(kLine);
    constexpr uint32_t kStages[kHudStages] = {0x6fb7d6, 0x7fc9b0, 0xb5c96a,
                                              0xf0a94b, 0xe5806b, 0xa996d8};
    for (size_t i = 0; i < kHudStages; ++i) theme.stages[i] = rgb(kStages[i]);
    theme.editor = editor_colors();
    return theme;
}

}  // namespace kinora::play
