// runtime/scene/build/views.cpp: the directions that scenes are looked at from when no camera of
// theirs is.
#include "runtime/scene/build/views.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace kinora {

namespace {

constexpr ViewWord kViews[] = {
    {"auto", 1, 0.6, 1, false}, {"front", 0, 0, 1, true}, {"back", 0, 0, -1, true},
    {"left", -1, 0, 0, true},   {"right", 1, 0, 0, true}, {"top", 0, 1, 0, true},
    {"iso", 1, 1, 1, true},
};

constexpr double kLeastSine = 1e-9;  // between a view and what is up

}  // namespace

std::span<const ViewWord> view_words() {
    return kViews;
}

const ViewWord* find_view(std::string_view word) {
    const ViewWord* row = std::ranges::find(kViews, word, &ViewWord::word);
    return row == std::end(kViews) ? nullptr : row;
}

ViewAxes up_axis_frame(UpAxis up) {
    switch (up) {
        case UpAxis::X:
            return {dvec3(0, -1, 0), dvec3(1, 0, 0), dvec3(0, 0, 1)};
        case UpAxis::Y:
            return {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)};
        case UpAxis::Z:
            break;
    }
    return {dvec3(1, 0, 0), dvec3(0, 0, 1), dvec3(0, -1, 0)};
}

ViewAxes axes_towards(dvec3 back, const ViewAxes& frame) {
    back = glm::normalize(back);
    dvec3 right = glm::cross(frame.up, back);
    right = glm::length(right) > kLeastSine ? glm::normalize(right) : frame.right;
    return {right, glm::cross(back, right), back};
}

}  // namespace kinora
