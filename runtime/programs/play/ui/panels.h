// runtime/programs/play/ui/panels.h: the panels, each drawn into the window it finds open.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "runtime/programs/play/raster/raster.h"
#include "runtime/programs/play/ui/context.h"

namespace kinora::play {

// The tree of nodes: what moves, deforms or stands.
class NodesPanel {
  public:
    void draw(Context& context);

  private:
    void list(const SceneInfo& scene);
    void row(Context& context, const SceneInfo& scene, size_t index);

    uint64_t scene_ = 0;
    std::set<uint32_t> closed_;
    std::vector<uint32_t> shown_;  // rows of SceneInfo::nodes
    std::vector<char> has_children_;
    std::string filter_, shown_filter_;
    std::string selected_;  // as last scrolled to
};

// The materials, and the parameters of the one being edited.
void draw_parameters(Context& context);

// The shader's text.
class EditorPanel {
  public:
    explicit EditorPanel(const EditorColors& colors) : pane_(colors) {}
    void draw(Context& context);
    bool focused() const { return pane_.focused(); }
    void release() { pane_.focus(false); }

  private:
    void toolbar(Context& context, const ShaderDocument& document);
    void follow(const ShaderDocument& document);
    void follow_selection(Context& context);

    EditorPane pane_;
    std::string selected_;  // material
    std::string material_;
    uint64_t version_ = 0;
    size_t caret_ = 0;  // as the player has it
};

// The lights, one of which may shine alone.
void draw_lights(Context& context);
// The slider of quality, and what a picture of each stop took and misses.
void draw_quality(Context& context);

// Our shaders on the selected object.
class LibraryPanel {
  public:
    void draw(Context& context);

  private:
    // Kept while the rasteriser reads them.
    std::vector<std::shared_ptr<const Thumbnail>> shown_;
    std::vector<Texture> textures_;
};

// kinora-render --explain, section by section.
void draw_explained(Context& context);

void draw_findings(Context& context);

// The file in which a finding stands that is in no text of a shader.
class SourcePanel {
  public:
    void draw(Context& context);

  private:
    void read(const SourcePlace& place);
    void row(const Theme& theme, size_t index) const;

    std::string file_, text_;
    std::vector<size_t> starts_;  // of lines
    int line_ = 0, column_ = 0, raised_ = 0;
    bool whole_ = false, scrolls_ = false;
};

// Everything known of the pixel that was clicked.
void draw_pixel(Context& context);
// Of that, its shaders' variables statement by statement.
void draw_story(Context& context, const PixelStory& story);
// Stage times of the last frames, as stacked bars: `size` at the cursor.
void draw_stage_times(Context& context, ImVec2 size);
void draw_times(Context& context);

// Transport buttons and the ruler of frames.
class Timeline {
  public:
    void draw(Context& context);
    float height(const Theme& theme) const { return theme.px(74); }

  private:
    void transport(Context& context);
    void ruler(Context& context);
};

// The picture, and the mouse over it.
class Viewport {
  public:
    // `follow_size`: the picture is made of as many pixels as there are here.
    explicit Viewport(bool follow_size) : follow_size_(follow_size) {}
    void draw(Context& context, ImVec2 corner, ImVec2 size);
    // The pixel under the pointer in words; "" none.
    const std::string& under_pointer() const { return under_pointer_; }
    // Seconds until it has to be drawn again; < 0: never by itself.
    double next_turn() const { return next_turn_; }
    // What the keys of flight say: -1 to 1 along right, up and into the picture.
    void steer(dvec3 steering) { steering_ = steering; }
    bool may_fly() const { return button_ == 1; }

  private:
    void place(const Picture& picture, ImVec2 corner, ImVec2 size);
    void follow(Context& context, ImVec2 size);
    void take_mouse(Context& context, bool hovered);
    void take_wheel(Context& context);
    bool take_wipe(Context& context, bool hovered);
    bool take_flight(Context& context);
    void turn(const char* word, Context& context, ImVec2 moved);
    float wipe_x(const PictureState& state) const;
    void draw_wipe(const Context& context) const;
    void draw_scale(const Theme& theme, const NumberScale& scale) const;
    void show_under_pointer(const Context& context);
    void overlay(Context& context, ImVec2 corner, ImVec2 size);

    bool follow_size_;
    std::shared_ptr<const Picture> picture_;  // drawn; kept while the rasteriser reads it
    Texture texture_;
    ImVec2 low_{0, 0}, high_{0, 0};  // where it is on the screen
    int width_ = 0, height_ = 0;     // asked for last
    double wanted_since_ = 0, next_turn_ = -1;
    ImVec2 wanted_{0, 0};
    int button_ = -1;  // held down
    bool moved_ = false, wiping_ = false;
    dvec3 steering_{0.0};
    std::string under_pointer_;
};

// The rows of the table as a menu bar.
void draw_menu(Context& context);

// Any command by name.
class Palette {
  public:
    // `wanted`: as the state has it.
    void draw(Context& context, bool wanted);
    bool open() const { return open_; }

  private:
    void find();
    void execute(Context& context);

    bool open_ = false, focus_ = false;
    char text_[512] = "";
    std::string searched_;
    std::vector<const Command*> found_;
    size_t chosen_ = 0;
};

// All keys at a glance.
void draw_cheat_sheet(Context& context);

}  // namespace kinora::play
