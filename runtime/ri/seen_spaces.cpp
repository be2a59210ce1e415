// runtime/ri/seen_spaces.cpp: an interpreter that gets no shader and no primitive.
#include "runtime/ri/seen_spaces.h"

#include <limits>

namespace kinora::ri {
namespace {

bool matters(Request request) {
    switch (row(request).kind) {
        case RequestClass::Block:
        case RequestClass::Transform:
        case RequestClass::Anywhere:
            return true;
        case RequestClass::Option:
            return request != Request::Imager && request != Request::Display;
        default:
            return false;
    }
}

// A world that no file has: of none are primitives made.
ImportOptions no_pictures() {
    ImportOptions options;
    options.world = std::numeric_limits<int>::max();
    return options;
}

InterpreterHost nobody() {
    return {[](SceneDescription&&) {}, [](const std::string&) { return false; }};
}

}  // namespace

SeenSpaces::SeenSpaces() : state_("", no_pictures(), nobody(), unheard_) {}

void SeenSpaces::see(const Call& call) {
    if (!matters(call.request)) return;
    state_.call(call);
    unheard_.clear();
}

bool SeenSpaces::transform_points(std::string_view from, std::string_view to,
                                  std::span<float> points) {
    return state_.transform_points(from, to, points);
}

}  // namespace kinora::ri
