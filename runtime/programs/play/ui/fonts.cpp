// runtime/programs/play/ui/fonts.cpp: fonts with the letters that names of scenes have.
#include <imgui_freetype.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "runtime/programs/play/ui/theme.h"

namespace kinora::play {

namespace {

constexpr const char* kFolders[] = {
    "/usr/share/fonts/truetype/dejavu",
    "/usr/share/fonts/dejavu",
    "/usr/share/fonts/TTF",
    "/usr/share/fonts/dejavu-sans-fonts",
};

// Latin, Greek, Cyrillic; punctuation, arrows, signs of mathematics.
constexpr ImWchar kLetters[] = {0x20,   0x24f,  0x370,  0x3ff,  0x400,  0x4ff,  0x2010, 0x2060,
                                0x2190, 0x21ff, 0x2200, 0x226f, 0x25a0, 0x25ff, 0};
constexpr ImWchar kLatin[] = {0x20, 0x17f, 0x2010, 0x2030, 0x2190, 0x2193, 0};

std::string font_file(const char* name) {
    for (const char* folder : kFolders) {
        std::string file = std::string(folder) + "/" + name;
        std::error_code error;
        if (std::filesystem::is_regular_file(file, error)) return file;
    }
    return {};
}

ImFont* add(const char* name, float size, const ImWchar* letters) {
    const std::string file = font_file(name);
    if (file.empty()) return nullptr;
    ImFontConfig config;
    config.OversampleH = 1;
    config.PixelSnapH = true;
    return ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), size, &config, letters);
}

}  // namespace

Fonts load_fonts(float scale) {
    ImFontAtlas* atlas = ImGui::GetIO().Fonts;
    atlas->Clear();
    atlas->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    atlas->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    atlas->TexGlyphPadding = 1;
    const auto size = [scale](float points) { return std::round(points * scale); };
    Fonts fonts;
    fonts.text = add("DejaVuSans.ttf", size(15), kLetters);
    if (!fonts.text) {
        ImFontConfig config;
        config.SizePixels = size(14);
        fonts.text = atlas->AddFontDefault(&config);
        fonts.bold = fonts.mono = fonts.text;
        return fonts;
    }
    fonts.found = true;
    fonts.bold = add("DejaVuSans-Bold.ttf", size(15), kLatin);
    fonts.mono = add("DejaVuSansMono.ttf", size(15), kLetters);
    if (!fonts.bold) fonts.bold = fonts.text;
    if (!fonts.mono) fonts.mono = fonts.text;
    return fonts;
}

}  // namespace kinora::play
