// runtime/programs/play/ui/letters.cpp: UTF-8 to letters; font files asked by FreeType.
#include "runtime/programs/play/ui/letters.h"

#include <ft2build.h>
#include FT_FREETYPE_H

#include <imgui_internal.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace kinora::play {

namespace {

// Few, since all are drawn before the first panels are.
constexpr ImWchar kFirst[] = {0x20, 0xff, 0x2010, 0x2030, 0x2190, 0x2193, 0};
constexpr size_t kMostLetters = 4096;  // beyond the first ones: what a texture can hold
constexpr size_t kMostFonts = 2000;    // files that are opened for a letter

bool is_first(unsigned letter) {
    for (const ImWchar* range = kFirst; *range; range += 2)
        if (letter >= range[0] && letter <= range[1]) return true;
    return false;
}

// Sorted, so that the same one is chosen on each start.
std::vector<std::string> font_files() {
    std::vector<std::string> folders{"/usr/share/fonts", "/usr/local/share/fonts"};
    if (const char* home = std::getenv("HOME"))
        folders.push_back(std::string(home) + "/.local/share/fonts");
    std::vector<std::string> files;
    namespace fs = std::filesystem;
    for (const std::string& folder : folders) {
        std::error_code error;
        fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied,
                                            error);
        for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
            const std::string kind = at->path().extension().string();
            if (kind == ".ttf" || kind == ".otf" || kind == ".ttc")
                files.push_back(at->path().string());
        }
    }
    std::sort(files.begin(), files.end());
    if (files.size() > kMostFonts) files.resize(kMostFonts);
    return files;
}

std::vector<ImWchar> letters_in(FT_Library library, const std::string& file,
                                const std::set<ImWchar>& wanted) {
    std::vector<ImWchar> found;
    FT_Face face = nullptr;
    if (FT_New_Face(library, file.c_str(), 0, &face) != 0) return found;
    if (FT_IS_SCALABLE(face))
        for (const ImWchar letter : wanted)
            if (FT_Get_Char_Index(face, letter) != 0) found.push_back(letter);
    FT_Done_Face(face);
    return found;
}

}  // namespace

bool Letters::add(std::string_view text) {
    bool some = false;
    const char *at = text.data(), *end = at + text.size();
    while (at < end) {
        if (static_cast<unsigned char>(*at) < 0x80) {
            ++at;
            continue;
        }
        unsigned letter = 0;
        at += std::max(1, ImTextCharFromUtf8(&letter, at, end));
        if (letter < 0x80 || letter >= IM_UNICODE_CODEPOINT_INVALID || is_first(letter)) continue;
        if (all_.size() < kMostLetters) some |= all_.insert(static_cast<ImWchar>(letter)).second;
    }
    return some;
}

const ImWchar* first_letters() {
    return kFirst;
}

std::vector<std::pair<std::string, std::vector<ImWchar>>> fonts_with(std::set<ImWchar> letters) {
    std::vector<std::pair<std::string, std::vector<ImWchar>>> fonts;
    FT_Library library = nullptr;
    if (letters.empty() || FT_Init_FreeType(&library) != 0) return fonts;
    for (const std::string& file : font_files()) {
        if (letters.empty()) break;
        std::vector<ImWchar> found = letters_in(library, file, letters);
        if (found.empty()) continue;
        for (const ImWchar letter : found) letters.erase(letter);
        fonts.emplace_back(file, std::move(found));
    }
    FT_Done_FreeType(library);
    return fonts;
}

std::vector<ImWchar> ranges_of(const std::vector<ImWchar>& sorted) {
    std::vector<ImWchar> ranges;
    for (const ImWchar letter : sorted) {
        if (!ranges.empty() && ranges.back() + 1 == letter)
            ranges.back() = letter;
        else
            ranges.insert(ranges.end(), {letter, letter});
    }
    ranges.push_back(0);
    return ranges;
}

}  // namespace kinora::play
