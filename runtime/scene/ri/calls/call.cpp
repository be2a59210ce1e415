// runtime/scene/ri/calls/call.cpp: the table of requests.
#include "runtime/scene/ri/calls/call.h"

#include <array>
#include <string>
#include <unordered_map>

namespace kinora::ri {
namespace {

constexpr RequestRow kRequests[] = {
#define REQUEST(name, arguments, class) {#name, arguments, RequestClass::class},
#include "runtime/scene/ri/calls/requests.def"
#undef REQUEST
};

}  // namespace

std::span<const RequestRow> requests() {
    return kRequests;
}

const Request* find_request(std::string_view name) {
    static const auto by_name = [] {
        std::unordered_map<std::string_view, Request> map;
        for (size_t i = 0; i < std::size(kRequests); ++i)
            map.emplace(kRequests[i].name, Request(i));
        return map;
    }();
    auto found = by_name.find(name);
    return found == by_name.end() ? nullptr : &found->second;
}

std::string_view shader_of(Request request, std::span<const Values> arguments) {
    const size_t at = request == Request::ShaderLayer ? 1 : 0;
    return at < arguments.size() ? arguments[at].string() : "";
}

uint32_t Counts::of(StorageClass storage) const {
    switch (storage) {
        case StorageClass::Constant:
            return 1;
        case StorageClass::Uniform:
            return uniform;
        case StorageClass::Varying:
            return varying;
        case StorageClass::Vertex:
            return vertex;
        case StorageClass::FaceVarying:
            return face_varying;
    }
    return 1;
}

}  // namespace kinora::ri
