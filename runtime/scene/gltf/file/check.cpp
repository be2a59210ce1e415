// runtime/scene/gltf/file/check.cpp: guards around tinygltf, which trusts the numbers of a file.
#include "runtime/scene/gltf/file/check.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/scene/gltf/file/file.h"
#include "runtime/scene/gltf/file/json_scan.h"

namespace kinora {

namespace {

// Extensions that say of a buffer that its bytes are made from those of another one.
constexpr std::string_view kPackedBy[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

std::string_view part(std::string_view json, JsonRange range) {
    return json.substr(range.begin, range.end - range.begin);
}

// The .glb's binary chunk belongs to the first buffer alone (glTF 2.0, 4.4.3.3); tinygltf copies it
// for each buffer without a uri.
std::string check_buffers(const std::vector<GltfBuffer>& buffers, bool binary) {
    for (size_t b = 0; b < buffers.size(); ++b) {
        if (!buffers[b].uri.empty() || buffers[b].data) continue;
        if (!buffers[b].packed_by.empty())
            return fmt::format("buffer {} has no uri: {} fills it, which is not supported", b,
                               buffers[b].packed_by);
        if (!binary) return fmt::format("buffer {} has no uri", b);
        if (b > 0) return fmt::format("buffer {} has no uri and is not the first", b);
        if (buffers[b].bytes == 0) return "buffer 0 has no bytes";
    }
    return "";
}

struct ImageView {
    double offset = 0, length = -1, buffer = -1;
};

// tinygltf forms the address of an image's first byte before anyone checks it.
std::string check_images(std::string_view json, const std::vector<GltfBuffer>& buffers) {
    std::vector<JsonRange> images = json_elements(json, "/images");
    if (images.empty()) return "";
    std::vector<ImageView> views;
    for (JsonRange range : json_elements(json, "/bufferViews")) {
        std::string_view view = part(json, range);
        views.push_back({json_number(view, "/byteOffset", 0), json_number(view, "/byteLength", -1),
                         json_number(view, "/buffer", -1)});
    }
    for (size_t i = 0; i < images.size(); ++i) {
        double index = json_number(part(json, images[i]), "/bufferView", -1);
        if (!json_find(part(json, images[i]), "/bufferView")) continue;
        if (!(index >= 0 && index < double(views.size())))
            return fmt::format("image {} names buffer view {}, which is not there", i, index);
        const ImageView& view = views[size_t(index)];
        bool known = view.buffer >= 0 && view.buffer < double(buffers.size());
        if (!known || !(view.offset >= 0 && view.length > 0 &&
                        view.offset + view.length <= double(buffers[size_t(view.buffer)].bytes)))
            return fmt::format("image {} reaches past the end of its buffer", i);
    }
    return "";
}

}  // namespace

std::vector<GltfBuffer> gltf_buffers(std::string_view json) {
    std::vector<GltfBuffer> buffers;
    for (JsonRange range : json_elements(json, "/buffers")) {
        std::string_view text = part(json, range);
        GltfBuffer& buffer = buffers.emplace_back();
        double bytes = json_number(text, "/byteLength", 0);
        buffer.bytes = bytes > 0 && bytes < 1e15 ? size_t(bytes) : 0;
        for (std::string_view extension : kPackedBy)
            if (json_find(text, fmt::format("/extensions/{}", extension)))
                buffer.packed_by = extension;
        std::optional<JsonRange> uri = json_find(text, "/uri");
        if (!uri) continue;
        buffer.data = part(text, *uri).starts_with("\"data:");
        SourceMap map;
        if (!buffer.data) buffer.uri = json_string(text, *uri, kNoFile, map);
    }
    return buffers;
}

void cut_gltf_data(std::span<char> json) {
    std::string_view whole(json.data(), json.size());
    for (JsonRange range : json_elements(whole, "/buffers")) {
        std::string_view text = part(whole, range);
        double bytes = json_number(text, "/byteLength", 0);
        std::optional<JsonRange> uri = json_find(text, "/uri");
        if (!uri || !(bytes > 0 && bytes < 1e15)) continue;
        size_t at = text.find(";base64,", uri->begin), quote = uri->end - 1;
        if (at >= quote || !part(text, *uri).starts_with("\"data:")) continue;
        size_t wanted = (size_t(bytes) * 8 + 5) / 6, letters = 0, end = quote;
        for (at += 8; at < quote && text[at] != '='; ++letters) {
            if (letters == wanted) end = at;
            // JSON may write the slash among the letters as "\/" or "\u002F".
            at += text[at] != '\\' ? 1 : text[at + 1] == 'u' ? 6 : 2;
        }
        if (letters * 6 / 8 <= size_t(bytes)) continue;
        char* chars = &json[range.begin];
        chars[end] = '"';
        std::fill(chars + end + 1, chars + uri->end, ' ');
    }
}

// tinygltf recurses by depth and takes about a kilobyte an object.
std::string check_gltf_shape(std::string_view json, size_t bytes) {
    JsonShape shape = json_shape(json);
    if (shape.depth > kMaxGltfDepth)
        return fmt::format("its JSON is nested {} deep, more than {}", shape.depth, kMaxGltfDepth);
    size_t limit = std::min(kMaxGltfContainers, size_t(65536) + bytes / 16);
    if (shape.containers > limit)
        return fmt::format("its JSON has {} arrays and objects, more than {}", shape.containers,
                           limit);
    return "";
}

std::string check_gltf_json(std::string_view json, bool binary) {
    std::vector<GltfBuffer> buffers = gltf_buffers(json);
    std::string error = check_buffers(buffers, binary);
    return error.empty() ? check_images(json, buffers) : error;
}

}  // namespace kinora
