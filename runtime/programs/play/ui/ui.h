// runtime/programs/play/ui/ui.h: the whole window's content, drawn with Dear ImGui once a turn.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/programs/play/ui/context.h"
#include "runtime/programs/play/ui/letters.h"
#include "runtime/programs/play/ui/panels.h"

namespace kinora::play {

class Ui {
  public:
    // For the current ImGui context. `follow_size`: see Viewport.
    Ui(Player& player, const Layout& layout, float scale, bool follow_size);
    Ui(const Ui&) = delete;

    // Between ImGui::NewFrame and Render.
    void draw();
    // The same into memory: a whole frame of ImGui's.
    void render(const Target& target, float seconds);

    // A key of the table by its name: "Ctrl+S". False: no row has it, or the keyboard belongs to a
    // text.
    bool press(const std::string& key);
    // Text from the keyboard: from the next turn on there are letters for it.
    void typed(const char* text) { typed_some_ |= letters_.add(text); }
    // The keys of flight, see Viewport.
    void steer(dvec3 steering) { viewport_.steer(steering); }
    // Whether letters are text at present.
    bool wants_text() const;
    // Seconds until it changes by itself; < 0: never.
    double next_turn() const;

    const Layout& layout() const { return layout_; }
    Context& context() { return context_; }

  private:
    struct Box {
        ImVec2 low, high;
        ImVec2 size() const { return {high.x - low.x, high.y - low.y}; }
    };
    void take_fonts();
    void follow_letters();
    void restore_panels();
    void remember_panels();
    bool shows(Area area) const;
    void follow_opened();
    void draw_area(Area area, const Box& box);
    void draw_panel(const char* name);
    void splitter(Area area, const Box& box);
    void tell_findings(float x, const Box& box);
    void status_bar(const Box& box);
    void draw_toast(const Box& box);

    Layout layout_;
    Theme theme_;
    Texture font_;
    Letters letters_;
    bool typed_some_ = false;                          // letters that the fonts do not have yet
    uint64_t lettered_scene_ = 0, lettered_text_ = 0;  // looked through for letters
    std::string lettered_material_;
    size_t lettered_findings_ = 0;
    Context context_;
    NodesPanel nodes_;
    LibraryPanel library_;
    EditorPanel editor_;
    SourcePanel source_;
    Timeline timeline_;
    Viewport viewport_;
    Palette palette_;
    bool failed_ = false;
    std::vector<std::string> opened_;  // panels, as of the last turn
    bool followed_ = false;
    int raised_ = 0;  // as the state has it
    std::optional<Area> narrow_side_;
};

}  // namespace kinora::play
