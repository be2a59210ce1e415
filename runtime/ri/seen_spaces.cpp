// runtime/ri/seen_spaces.cpp: an interpreter that gets no shader and no primitive.
#include "runtime/ri/seen_spaces.h"

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

// Of none are primitives made.
const WorldChoice kNoWorld{.worlds = {-1}};

InterpreterHost nobody() {
    return {[](SceneDescription&&) {}, [](const std::string&) { return false; }};
}

}  // namespace

SeenSpaces::SeenSpaces() : state_("", ImportOptions(), kNoWorld, nobody(), unheard_) {}

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
