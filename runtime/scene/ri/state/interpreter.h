// runtime/scene/ri/state/interpreter.h: calls of the interface to scenes: a description for each
// world block.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene/ri/calls/call_list.h"
#include "runtime/scene/ri/state/attribute_calls.h"
#include "runtime/scene/ri/state/branches.h"
#include "runtime/scene/ri/state/option_calls.h"
#include "runtime/scene/ri/state/recorded_shaders.h"
#include "runtime/scene/ri/state/shader_calls.h"
#include "runtime/scene/ri/state/transform_calls.h"
#include "runtime/scene/ri/state/world_choice.h"

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
    // `path`: of the file that the calls come from, or of one that would stand where the program
    // runs.
    Interpreter(std::string path, const ImportOptions& options, WorldChoice drawn,
                InterpreterHost host, Diagnostics& diagnostics);
    ~Interpreter() override;

    void call(const Call& call) override;
    const Declaration* declared_by_shader(Request request, std::string_view shader,
                                          std::string_view token) override;
    std::optional<CountState> count_state() override;
    bool transform_points(std::string_view from, std::string_view to,
                          std::span<float> points) override;
    // The file's end: closes what is open, with a finding.
    void finish();

  private:
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
    bool record(const Call& call);
    bool enter(const std::string& name);
    void leave();
    void replay(const CallList& calls);
    bool read_archive_file(const std::string& name, Location where);
    void procedural(const Call& call);

    // Primitives (drawing.cpp).
    void primitive(const Call& call);
    Tessellation judged(const Call& call, Tessellation made, const TessellationLimits& limits);
    void nothing_left(const Call& call);
    void geometry(const Call& call);
    void not_drawn(const Call& call);
    bool is_visible() const;
    std::optional<MeshKey> key_of(const Call& call, PictureScale& scale) const;
    std::optional<MeshDefinition> kept_mesh(const MeshKey& key, const Call& call,
                                            const PictureScale& scale);
    std::optional<MeshDefinition> mesh_of_call(const Call& call, const PictureScale& scale,
                                               const TessellationLimits& limits);
    SubdivisionSurface subdivision_of(const Call& call);

    void dispatch(const Call& call);
    bool has_right_tokens(const Call& call);
    const rsl::ShaderParameter* formal_of_primitive(std::string_view name);

    StateReport report_;
    State state_;
    const WorldChoice drawn_;
    InterpreterHost host_;
    ShaderCalls shaders_;
    OptionCalls options_;
    AttributeCalls attributes_;
    TransformCalls transforms_;
    const std::shared_ptr<MeshStore> meshes_;
    Branches branches_;
    int worlds_ = 0;

    // What is kept instead of done: an archive, an object, or a motion block.
    struct Recording {
        Request end;
        int depth = 1;  // of blocks that begin as it does
        std::string archive;
        int object = 0;
        std::vector<float> times;
        Location where;
        std::shared_ptr<CallList> calls = std::make_shared<CallList>();
        RecordedShaders shaders = {};
    };
    std::vector<Recording> recording_;  // at most one but for motion in others
    std::map<std::string, std::shared_ptr<CallList>, std::less<>> archives_;
    std::map<int, std::shared_ptr<CallList>> objects_;
    std::vector<std::string> entered_;  // the objects and archives that are being read
    size_t replayed_ = 0;               // calls of them
    Declaration formal_;                // the last answer of declared_by_shader
};

}  // namespace kinora::ri
