// runtime/programs/play/ui/letters.h: the letters that texts need, and the fonts that have them.
#pragma once

#include <imgui.h>

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kinora::play {

// Letters beyond those that are always loaded, gathered from texts as UTF-8.
class Letters {
  public:
    // True where there was a new one.
    bool add(std::string_view text);
    const std::set<ImWchar>& all() const { return all_; }

  private:
    std::set<ImWchar> all_;
};

// What fonts hold from the start: Latin, Greek, Cyrillic, signs. Pairs of ImGui's, 0 at the end.
const ImWchar* first_letters();

// Fonts of the system that have some of the letters, each with those that no font before it has:
// of /usr/share/fonts and its like. Other letters are in none.
std::vector<std::pair<std::string, std::vector<ImWchar>>> fonts_with(std::set<ImWchar> letters);

// The same as ranges that ImGui reads, with 0 at the end.
std::vector<ImWchar> ranges_of(const std::vector<ImWchar>& sorted);

}  // namespace kinora::play
