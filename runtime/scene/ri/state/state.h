// runtime/scene/ri/state/state.h: what all requests work on: the graphics state, and who hears what
// is wrong.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/import_options.h"
#include "runtime/scene/ri/calls/call.h"
#include "runtime/scene/ri/state/graphics_state.h"
#include "runtime/scene/ri/state/world.h"

namespace kinora::ri {

// Findings about the call that is being done.
class StateReport {
  public:
    explicit StateReport(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    template <class... Args>
    void add(const FindingInfo& info, const Args&... args) {
        diagnostics_.report(info, now_ ? now_->where : Location{}, args...);
    }
    template <class... Args>
    void add_at(const FindingInfo& info, Location where, const Args&... args) {
        diagnostics_.report(info, where, args...);
    }
    // Once a file: what of the interface is read and has no effect.
    void not_done(std::string_view what, std::string_view why);
    // Of the file where that is, with its slash; "": of none.
    std::string folder_of(Location where) const;
    // Whether this is said for the first time.
    bool is_new(std::string text) { return told_.insert(std::move(text)).second; }

    // The call that findings are about; returns the one before it.
    const Call* begin(const Call* call) { return std::exchange(now_, call); }

  private:
    Diagnostics& diagnostics_;
    const Call* now_ = nullptr;
    std::set<std::string> told_;
};

// What a block saves. Its end restores what it says of them.
struct Block {
    Request begin;
    Location where;
    Attributes attributes;
    dmat4 transform;
    std::unique_ptr<Options> options;                  // of frames
    std::map<std::string, dmat4, std::less<>> scoped;  // coordinate systems that end with it
};

struct State {
    std::string path;  // of the first file
    ImportOptions import;
    Options options;
    Attributes attributes;
    dmat4 transform{1.0};          // to the world, or the camera outside of a world
    dmat4 camera_from_world{1.0};  // identity outside of a world
    std::map<std::string, dmat4, std::less<>> spaces;  // to the camera
    std::optional<int> frame;                          // of the open frame block
    std::vector<Block> blocks;
    std::unique_ptr<World> world;  // null outside of a world block

    dmat4 to_camera() const { return camera_from_world * transform; }
    bool in_world() const { return world != nullptr; }
};

// Numbers of a colour, as many as ColorSamples says; what is not finite is 0.
dvec3 rgb_of(const Values& values, const Options& options);

// Keeps what Option or Attribute says.
void keep_told(std::shared_ptr<const ToldValues>& told, const Call& call);

// Which function of a class does which request.
template <class Class>
class Handlers {
  public:
    using Handler = void (Class::*)(const Call&);
    struct Row {
        Request request;
        Handler handler;
    };
    Handlers(std::initializer_list<Row> rows) : by_request_(requests().size(), nullptr) {
        for (const Row& row : rows) by_request_[size_t(row.request)] = row.handler;
    }
    // False: none of them does.
    bool call(Class& object, const Call& call) const {
        Handler handler = by_request_[size_t(call.request)];
        if (handler) (object.*handler)(call);
        return handler != nullptr;
    }

  private:
    std::vector<Handler> by_request_;
};

}  // namespace kinora::ri
