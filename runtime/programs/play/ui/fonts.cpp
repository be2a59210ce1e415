// runtime/programs/play/ui/fonts.cpp: fonts with the letters that names of scenes have.
#include <imgui_freetype.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "runtime/programs/play/ui/letters.h"
#include "runtime/programs/play/ui/theme.h"

namespace kinora::play {

namespace {

constexpr const char* kFolders[] = {
    "/usr/share/fonts/truetype/dejavu",
    "/usr/share/fonts/dejavu",
    "/usr/share/fonts/TTF",
    "/usr/share/fonts/dejavu-sans-fonts",
};

std::string font_file(const char* name) {
    for (const char* folder : kFolders) {
        std::string file = std::string(folder) + "/" + name;
        std::error_code error;
        if (std::filesystem::is_regular_file(file, error)) return file;
    }
    return {};
}

ImFont* add_file(const std::string& file, float size, const ImWchar* letters, bool merge) {
    if (file.empty()) return nullptr;
    ImFontConfig config;
    config.OversampleH = 1;
    config.PixelSnapH = true;
    config.MergeMode = merge;
    return ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), size, &config, letters);
}

// Files with letters that are merged into each font, and their ranges, which the atlas reads when
// it is built.
using Further = std::vector<std::pair<std::string, std::vector<ImWchar>>>;

ImFont* add(const char* name, float size, const ImWchar* letters, const Further& further) {
    const std::string own = font_file(name);
    ImFont* font = add_file(own, size, letters, false);
    if (!font) return nullptr;
    for (const auto& [file, ranges] : further) {
        add_file(own, size, ranges.data(), true);  // in its own form, if it has them
        if (file != own) add_file(file, size, ranges.data(), true);
    }
    return font;
}

}  // namespace

Fonts load_fonts(float scale, const Letters& letters) {
    ImFontAtlas* atlas = ImGui::GetIO().Fonts;
    atlas->Clear();
    atlas->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    atlas->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    atlas->TexGlyphPadding = 1;
    const auto size = [scale](float points) { return std::round(points * scale); };
    Further further;
    for (const auto& [file, some] : fonts_with(letters.all()))
        further.emplace_back(file, ranges_of(some));
    Fonts fonts;
    fonts.text = add("DejaVuSans.ttf", size(15), first_letters(), further);
    if (!fonts.text) {
        ImFontConfig config;
        config.SizePixels = size(14);
        fonts.text = atlas->AddFontDefault(&config);
        for (const auto& [file, ranges] : further) add_file(file, size(14), ranges.data(), true);
        fonts.bold = fonts.mono = fonts.text;
    } else {
        fonts.found = true;
        fonts.bold = add("DejaVuSans-Bold.ttf", size(15), first_letters(), {});
        fonts.mono = add("DejaVuSansMono.ttf", size(15), first_letters(), further);
        if (!fonts.bold) fonts.bold = fonts.text;
        if (!fonts.mono) fonts.mono = fonts.text;
    }
    atlas->Build();  // while the ranges are there
    return fonts;
}

}  // namespace kinora::play
