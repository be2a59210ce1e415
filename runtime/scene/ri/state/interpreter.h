// runtime/scene/ri/state/interpreter.h: calls of the interface to scenes: a description for each
// world block.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/import_options.h"
#include "runtime/scene/ri/calls/call.h"
#include "runtime/scene/ri/calls/call_list.h"
#include "runtime/scene/ri/state/graphics_state.h"
#include "runtime/scene/ri/state/shader_search.h"
#include "runtime/scene/ri/state/world.h"

namespace kinora::ri {

// What an interpreter asks of whoever reads files for it.
struct InterpreterHost {
    // A world block has ended.
    std::function<void(SceneDescription&& world)> take_world;
    // Reads an archive: its calls come while this runs. False: no such file.
    std::function<bool(const std::string& path)> read_archive;
};

class Interpreter : public CallSink {
  public:
    // With ImportOptions::world >= 0 the other worlds are without primitives.
    // `path`: of the file that the calls come from, or of one that would stand where the program
    // runs.
    Interpreter(std::string path, const ImportOptions& options, InterpreterHost host,
                Diagnostics& diagnostics);
    ~Interpreter() override;

    void call(const Call& call) override;
    const Declaration* declared_by_shader(Request request, std::string_view shader,
                                          std::string_view token) override;
    bool transform_points(std::string_view from, std::string_view to,
                          std::span<float> points) override;
    // The file's end: closes what is open, with a finding.
    void finish();

  private:
    struct Block {
        Request begin;
        Location where;
        Attributes attributes;
        dmat4 transform;
        std::unique_ptr<Options> options;                  // of frames
        std::map<std::string, dmat4, std::less<>> scoped;  // coordinate systems that end with it
    };
    using Handler = void (Interpreter::*)(const Call&);
    static const std::vector<Handler>& handlers();
    void dispatch(const Call& call);
    template <class... Args>
    void report(const FindingInfo& info, const Args&... args) {
        diagnostics_.report(info, now_->where, args...);
    }
    void not_done(const char* what, std::string_view why);  // once a file

    // Blocks (blocks.cpp).
    void begin_block(const Call& call);
    void end_block(const Call& call);
    void world_begin(const Call& call);
    void world_end(const Call& call);
    void close_world();
    void restore(Block& block);
    void motion_begin(const Call& call);
    void motion_end(const Call& call);
    void object_begin(const Call& call);
    void object_instance(const Call& call);
    void archive_begin(const Call& call);
    void read_archive(const Call& call);
    void if_begin(const Call& call);
    void branch_else(const Call& call);
    void if_end(const Call& call);
    bool record(const Call& call);
    void replay(const CallList& calls);
    void procedural(const Call& call);
    void ignore(const Call& call);

    // Options (options.cpp).
    void format(const Call& call);
    void frame_aspect_ratio(const Call& call);
    void screen_window(const Call& call);
    void crop_window(const Call& call);
    void projection(const Call& call);
    void clipping(const Call& call);
    void clipping_plane(const Call& call);
    void depth_of_field(const Call& call);
    void shutter(const Call& call);
    void pixel_samples(const Call& call);
    void pixel_filter(const Call& call);
    void exposure(const Call& call);
    void imager(const Call& call);
    void quantize(const Call& call);
    void display(const Call& call);
    void color_samples(const Call& call);
    void relative_detail(const Call& call);
    void option(const Call& call);

    // Attributes (attributes.cpp).
    void color(const Call& call);
    void opacity(const Call& call);
    void texture_coordinates(const Call& call);
    void shading_rate(const Call& call);
    void matte(const Call& call);
    void attribute(const Call& call);
    void detail(const Call& call);
    void detail_range(const Call& call);
    void orientation(const Call& call);
    void reverse_orientation(const Call& call);
    void sides(const Call& call);
    void basis(const Call& call);
    void trim_curve(const Call& call);
    dvec3 rgb(const Values& values) const;

    // Shaders and lights (shaders.cpp).
    void light_source(const Call& call);
    void area_light_source(const Call& call);
    void illuminate(const Call& call);
    void surface(const Call& call);
    void shader_layer(const Call& call);
    void co_shader(const Call& call);
    std::vector<Binding>* layers_of(std::string_view type);
    Binding bind(const Call& call, size_t name_at, std::string_view kind);
    ShaderBinding binding_of(const Call& call, std::shared_ptr<const rsl::Shader> shader);
    std::shared_ptr<const rsl::Shader> find_shader(std::string_view name);
    std::vector<std::string> folders(std::string_view kind) const;

    // Maps (maps.cpp).
    void make_map(const Call& call);
    void make_cube_map(const Call& call);
    void make_shadow(const Call& call);
    std::string map_name(std::string_view parameter, const std::string& name,
                         const rsl::Shader& shader);
    std::string picture_file(const std::string& name) const;

    // Transformations (transforms.cpp).
    void identity(const Call& call);
    void transform(const Call& call);
    void concat_transform(const Call& call);
    void perspective(const Call& call);
    void translate(const Call& call);
    void rotate(const Call& call);
    void scale(const Call& call);
    void skew(const Call& call);
    void coordinate_system(const Call& call);
    void scoped_coordinate_system(const Call& call);
    void coord_sys_transform(const Call& call);
    void concat(const dmat4& matrix);
    std::optional<dmat4> camera_from(std::string_view space) const;
    dvec4 at_unit_distance(dvec4 p, bool back) const;

    // Primitives (primitives.cpp).
    void primitive(const Call& call);
    void geometry(const Call& call);
    void not_drawn(const Call& call);
    bool in_detail() const;

    dmat4 to_camera() const { return camera_from_world_ * transform_; }
    bool in_world() const { return world_ != nullptr; }
    bool lists_alone() const { return import_.world == ImportOptions::kNoWorld; }
    bool is_drawn() const { return import_.world < 0 || import_.world == worlds_ - 1; }

    std::string path_;
    ImportOptions import_;
    InterpreterHost host_;
    Diagnostics& diagnostics_;
    ShaderSearch shaders_;

    Options options_;
    Attributes attributes_;
    dmat4 transform_{1.0};          // to the world, or the camera outside of a world
    dmat4 camera_from_world_{1.0};  // identity outside of a world
    std::vector<Block> blocks_;
    std::unique_ptr<World> world_;
    std::map<int, Light> lights_;
    std::map<std::string, std::string, std::less<>> maps_;  // that the file makes: their pictures
    std::set<std::string, std::less<>> shadows_;            // that it makes
    std::map<std::string, dmat4, std::less<>> spaces_;      // to the camera
    int worlds_ = 0;
    std::optional<int> frame_;

    // What is kept instead of done: an archive, an object, or a motion block.
    struct Recording {
        Request end;
        int depth = 1;  // of blocks that begin as it does
        std::string archive;
        int object = 0;
        std::vector<float> times;
        Location where;
        std::shared_ptr<CallList> calls = std::make_shared<CallList>();
    };
    std::vector<Recording> recording_;  // at most one but for motion in others
    std::map<std::string, std::shared_ptr<CallList>, std::less<>> archives_;
    std::map<int, std::shared_ptr<CallList>> objects_;
    int replay_depth_ = 0;
    size_t replayed_ = 0;
    int skipped_branch_ = 0;      // depth of IfBegin within a branch that is not read
    std::vector<bool> branches_;  // of open IfBegin: one was read
    const Call* now_ = nullptr;
    const Call* replayed_call_ = nullptr;  // the last that came from a list
    std::set<std::string> told_;
    Declaration formal_;  // the last answer of declared_by_shader
};

}  // namespace kinora::ri
