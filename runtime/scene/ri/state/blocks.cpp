// runtime/scene/ri/state/blocks.cpp: blocks, and what is kept between two requests instead of done.
#include <algorithm>
#include <cmath>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/state/interpreter.h"

namespace kinora::ri {
namespace {

constexpr size_t kDeepestReplay = 64;
constexpr size_t kMostReplayed = 5'000'000;  // calls of objects and archives, in a file

struct BlockRow {
    Request begin, end;
};
constexpr BlockRow kBlocks[] = {
    {Request::FrameBegin, Request::FrameEnd},
    {Request::WorldBegin, Request::WorldEnd},
    {Request::AttributeBegin, Request::AttributeEnd},
    {Request::TransformBegin, Request::TransformEnd},
    {Request::SolidBegin, Request::SolidEnd},
    // These are kept, and never among the open blocks.
    {Request::MotionBegin, Request::MotionEnd},
    {Request::ObjectBegin, Request::ObjectEnd},
    {Request::ArchiveBegin, Request::ArchiveEnd},
};

Request begin_of(Request end) {
    return std::ranges::find(kBlocks, end, &BlockRow::end)->begin;
}

bool is_operation(std::string_view solid) {
    return solid == "intersection" || solid == "union" || solid == "difference";
}

// What lies between two calls of one request: numbers are mixed, all else is the first's.
class Between {
  public:
    Between(const Call& a, const Call& b, float part) : call_(a), part_(part) {
        for (size_t i = 0; i < a.arguments.size(); ++i)
            arguments_.push_back(i < b.arguments.size() ? mix(a.arguments[i], b.arguments[i])
                                                        : a.arguments[i]);
        for (const Parameter& p : a.parameters) {
            parameters_.push_back(p);
            const Parameter* other = b.find(p.name);
            if (other) parameters_.back().values = mix(p.values, other->values);
        }
        call_.arguments = arguments_;
        call_.parameters = parameters_;
    }
    const Call& call() const { return call_; }

  private:
    Values mix(const Values& a, const Values& b) {
        auto from = a.floats(), to = b.floats();
        if (from.size() != to.size() || from.empty()) return a;
        std::vector<float>& mixed = *numbers_.emplace_back(new std::vector<float>);
        for (size_t i = 0; i < from.size(); ++i)
            mixed.push_back(from[i] + part_ * (to[i] - from[i]));
        return a.is_array() ? Values(std::span<const float>(mixed)) : Values(mixed[0]);
    }

    Call call_;
    float part_;
    std::vector<Values> arguments_;
    std::vector<Parameter> parameters_;
    std::vector<std::unique_ptr<std::vector<float>>> numbers_;
};

}  // namespace

void Interpreter::begin_block(const Call& call) {
    Block block{call.request, call.where, state_.attributes, state_.transform, nullptr, {}};
    if (call.request == Request::FrameBegin) {
        if (state_.in_world() || state_.frame)
            report_.add(Code::RI_NESTING, "FrameBegin", "a frame stands within another block");
        block.options = std::make_unique<Options>(state_.options);
        state_.frame = call.arguments[0].integer();
    }
    if (call.request == Request::SolidBegin && is_operation(call.arguments[0].string()))
        report_.not_done("SolidBegin", "solids are drawn as their surfaces");
    state_.blocks.push_back(std::move(block));
}

void Interpreter::world_begin(const Call& call) {
    if (state_.in_world())
        return report_.add(Code::RI_NESTING, "WorldBegin", "a world block stands within another");
    state_.blocks.push_back(
        {call.request, call.where, state_.attributes, state_.transform, nullptr, {}});
    state_.camera_from_world = state_.transform;
    state_.transform = dmat4(1.0);
    ++worlds_;
    if (drawn_.draws(worlds_ - 1)) meshes_->begin_world();
    shaders_.begin_world();
    state_.world = std::make_unique<World>(state_.options, state_.path, state_.import,
                                           state_.camera_from_world, state_.frame.value_or(worlds_),
                                           state_.frame.has_value());
}

void Interpreter::world_end(const Call& call) {
    if (!state_.in_world())
        return report_.add(Code::RI_NESTING, "WorldEnd", "no world block is open");
    end_block(call);
}

void Interpreter::close_world() {
    std::unique_ptr<World> world = std::move(state_.world);
    state_.camera_from_world = dmat4(1.0);
    SceneDescription made = world->take(state_.spaces);
    shaders_.end_world(worlds_ - 1, drawn_.counts_alone, *made.file_picture);
    host_.take_world(std::move(made));
}

void Interpreter::restore(Block& block) {
    if (block.begin == Request::WorldBegin) close_world();
    if (block.begin != Request::TransformBegin) state_.attributes = std::move(block.attributes);
    if (block.options) state_.options = std::move(*block.options);
    if (block.begin == Request::FrameBegin) state_.frame.reset();
    state_.transform = block.transform;
}

// An End closes its block and, with a finding, those opened since; one that has no block is left
// out. A world or frame is not closed by what stands within it.
void Interpreter::end_block(const Call& call) {
    const Request wanted = begin_of(call.request);
    size_t at = state_.blocks.size();
    while (at > 0 && state_.blocks[at - 1].begin != wanted) {
        bool outer = state_.blocks[at - 1].begin == Request::WorldBegin;
        if (outer && wanted != Request::FrameBegin) break;
        --at;
    }
    if (at == 0 || state_.blocks[at - 1].begin != wanted)
        return report_.add(Code::RI_NESTING, row(call.request).name, "its block is not open");
    if (at < state_.blocks.size())
        report_.add(
            Code::RI_NESTING, row(call.request).name,
            fmt::format("{} is still open and ends with it", row(state_.blocks.back().begin).name));
    while (state_.blocks.size() >= at) {
        Block block = std::move(state_.blocks.back());
        state_.blocks.pop_back();
        restore(block);
    }
}

void Interpreter::finish() {
    constexpr const char* kNotClosed = "it is not closed at the file's end";
    const std::vector<Block>& blocks = state_.blocks;
    if (!recording_.empty())
        report_.add_at(Code::RI_NESTING, recording_.back().where,
                       row(begin_of(recording_.back().end)).name, kNotClosed);
    else if (!blocks.empty())
        report_.add_at(Code::RI_NESTING, blocks.back().where, row(blocks.back().begin).name,
                       kNotClosed);
    recording_.clear();
    branches_.finish();
    while (!state_.blocks.empty()) {
        Block block = std::move(state_.blocks.back());
        state_.blocks.pop_back();
        restore(block);
    }
}

void Interpreter::motion_begin(const Call& call) {
    auto times = call.arguments[0].floats();
    Recording motion{Request::MotionEnd, 1, "", 0, {times.begin(), times.end()}, call.where};
    recording_.push_back(std::move(motion));
}

// Of the calls of a motion block the one at the shutter's opening is done.
void Interpreter::motion_end(const Call&) {
    if (recording_.empty() || recording_.back().end != Request::MotionEnd)
        return report_.add(Code::RI_NESTING, "MotionEnd", "its block is not open");
    Recording motion = std::move(recording_.back());
    recording_.pop_back();
    const std::vector<Call>& calls = motion.calls->calls();
    if (calls.empty()) return;
    if (calls.size() != motion.times.size())
        report_.add(Code::RI_MOTION,
                    fmt::format("{} times and {} calls", motion.times.size(), calls.size()));
    if (state_.options.shutter_close > state_.options.shutter_open)
        report_.not_done("MotionBegin", "things stand as at the opening of the shutter");
    size_t count = std::min(calls.size(), motion.times.size()), at = 0;
    const float open = float(state_.options.shutter_open);
    while (at + 1 < count && motion.times[at + 1] <= open) ++at;
    bool same = at + 1 < count && calls[at].request == calls[at + 1].request;
    if (!same || !(open > motion.times[at]))
        return this->call(calls[std::min(at, calls.size() - 1)]);
    float span = motion.times[at + 1] - motion.times[at];
    this->call(Between(calls[at], calls[at + 1], (open - motion.times[at]) / span).call());
}

void Interpreter::object_begin(const Call& call) {
    Recording object{Request::ObjectEnd, 1, "", call.arguments[0].integer(), {}, call.where};
    recording_.push_back(std::move(object));
}

void Interpreter::archive_begin(const Call& call) {
    std::string name(call.arguments[0].string());
    Recording archive{Request::ArchiveEnd, 1, std::move(name), 0, {}, call.where};
    recording_.push_back(std::move(archive));
}

// Whether the call is kept, and so not done now.
bool Interpreter::record(const Call& call) {
    if (recording_.empty()) return false;
    Recording& open = recording_.back();
    if (open.end == Request::MotionEnd) {
        if (call.request == Request::MotionEnd) return false;
        open.calls->add(call);
        return true;
    }
    bool object = open.end == Request::ObjectEnd;
    if (call.request == (object ? Request::ObjectBegin : Request::ArchiveBegin)) ++open.depth;
    if (call.request == open.end && --open.depth == 0) {
        if (object)
            objects_[open.object] = open.calls;
        else
            archives_[open.archive] = std::move(open.calls);
        recording_.pop_back();
        return true;
    }
    open.calls->add(call);
    open.shaders.follow(call);
    return true;
}

// Whether what `name` names may be read once more; until leave() it may not, since it would never
// end.
bool Interpreter::enter(const std::string& name) {
    const char* why = nullptr;
    if (std::ranges::count(entered_, name))
        why = "it stands within itself, and is left out there";
    else if (entered_.size() >= kDeepestReplay || replayed_ > kMostReplayed)
        why = "objects and archives stand within each other too deep or too often";
    if (!why) entered_.push_back(name);
    if (why && report_.is_new(why)) report_.add(Code::RI_RANGE, name, why);
    return !why;
}

void Interpreter::leave() {
    entered_.pop_back();
}

void Interpreter::replay(const CallList& calls) {
    for (const Call& call : calls.calls()) this->call(call);
}

void Interpreter::object_instance(const Call& call) {
    auto object = objects_.find(call.arguments[0].integer());
    if (object == objects_.end()) return report_.add(Code::RI_HANDLE, "ObjectInstance");
    if (!enter(fmt::format("object {}", object->first))) return;
    std::shared_ptr<CallList> calls = object->second;  // one of its calls may replace it
    Attributes attributes = state_.attributes;
    dmat4 transform = state_.transform;
    replay(*calls);
    leave();
    state_.attributes = std::move(attributes);
    state_.transform = transform;
}

void Interpreter::read_archive(const Call& call) {
    std::string name(call.arguments[0].string());
    if (!enter("archive " + name)) return;
    if (auto kept = archives_.find(name); kept != archives_.end()) {
        std::shared_ptr<CallList> calls = kept->second;
        replay(*calls);
    } else if (!read_archive_file(name, call.where)) {
        report_.add_at(Code::RI_ARCHIVE, call.where, name);
    }
    leave();
}

// Beside the file that names it, and in the folders of the first; then its bare name there.
bool Interpreter::read_archive_file(const std::string& name, Location where) {
    std::vector<std::string> folders = shaders_.folders("archive");
    folders.insert(folders.begin(), report_.folder_of(where));
    for (const std::string& folder : folders)
        if (host_.read_archive(folder + name)) return true;
    size_t slash = name.find_last_of("/\\");
    for (size_t i = 0; i < folders.size() && slash != name.npos; ++i)
        if (host_.read_archive(folders[i] + name.substr(slash + 1))) return true;
    return false;
}

void Interpreter::procedural(const Call& call) {
    auto strings = call.arguments[1].strings();
    if (call.arguments[0].string() != "DelayedReadArchive" || strings.empty())
        return report_.not_done("Procedural",
                                "programs and libraries that a file names are not run");
    std::vector<Values> arguments{strings[0]};
    Call archive{Request::ReadArchive, arguments, {}, {}, call.where};
    Attributes attributes = state_.attributes;
    dmat4 transform = state_.transform;
    read_archive(archive);
    state_.attributes = std::move(attributes);
    state_.transform = transform;
}

}  // namespace kinora::ri
