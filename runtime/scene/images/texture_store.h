// runtime/scene/images/texture_store.h: the images that names stand for, each read once.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "runtime/base/allowed_paths.h"
#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/images/map_distribution.h"
#include "runtime/scene/images/texture_pyramid.h"

namespace kinora {

// Pixels of a file, shared by all names with that path.
struct StoredImage {
    std::string path;  // as it was asked for
    std::string file;  // that was opened for it
    TexturePyramid pyramid;
    TextureFacts facts;
    std::vector<TexturePyramid> faces;  // six, of a cube
    // Of six pictures (CubeName): the tangent of half of the angle that each shows. 0: the faces
    // stand in a column of one file, as OpenEXR has them.
    float face_extent = 0;
    std::string error;                       // why it cannot be read, or ""; then it is checks
    mutable std::atomic<bool> asked{false};  // by a lookup; only kept where there is an error
    bool reported = false;
    bool by_module = false;  // decoded by OpenImageIO
};

struct Texture {
    Texture(TextureName m, const StoredImage* i) : modes(std::move(m)), image(i) {}
    TextureName modes;
    const StoredImage* image;
    // Directions by its light, made once (map_light.h).
    mutable std::once_flag lights_once;
    mutable std::unique_ptr<const MapDistribution> by_light;
};

class TextureStore {
  public:
    TextureStore() = default;
    // Only files of these trees are read; any other is as one that cannot be read. With `decode`
    // false, pixels are what the files hold, never decoded from sRGB (--color legacy). `from_top`:
    // t of texture() is 0 at the top.
    explicit TextureStore(AllowedPaths trees, bool decode = true, bool from_top = false)
        : trees_(std::move(trees)), decode_(decode), from_top_(from_top) {}
    ~TextureStore();
    TextureStore(const TextureStore&) = delete;

    static TextureStore& process();  // of shaders that belong to no scene; reads any file

    // The texture of an interned name, read now if it has not been met: then, and only then, it
    // locks and allocates. Null for the name "".
    const Texture* find(int32_t name);

    // Reads the files that these names (texture_name.h) stand for, in parallel; names without a
    // file are skipped. Forgets that unreadable files were reported: a new scene begins.
    void preload(std::span<const std::string> names);

    // One finding for each unreadable file that find's callers asked for and that is not reported,
    // not even by the reader of the scene (collada::Code::FILE_MISSING and its like).
    void report(Diagnostics& diagnostics);

    bool from_top() const { return from_top_; }
    int images() const;
    // Of all texels that were read, coarser levels included.
    uint64_t decoded_bytes() const;
    // Calls see(image) for each, by path; the store may not be asked meanwhile.
    void each_image(const std::function<void(const StoredImage&)>& see) const;

  private:
    static constexpr int kChunkBits = 12, kChunks = 1 << 12;
    using Chunk = std::array<std::atomic<const Texture*>, 1 << kChunkBits>;
    const Texture* meet(int32_t name);
    const StoredImage* image(const std::string& name, bool data);

    const AllowedPaths trees_;
    const bool decode_ = true, from_top_ = false;
    std::array<std::atomic<Chunk*>, kChunks> chunks_{};  // by name
    mutable std::mutex mutex_;                           // guards the maps and changes of chunks_
    std::map<int32_t, std::unique_ptr<Texture>> textures_;
    std::map<std::pair<std::string, bool>, std::unique_ptr<StoredImage>> images_;  // path, is data
};

}  // namespace kinora
