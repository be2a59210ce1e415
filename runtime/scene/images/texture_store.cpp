// runtime/scene/images/texture_store.cpp: names to textures without locks; files read once.
#include "runtime/scene/images/texture_store.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "collada/document/findings.h"
#include "rsl/model/renderer_services.h"
#include "rsl/text/findings.h"
#include "runtime/base/math.h"
#include "runtime/base/parallel.h"
#include "runtime/base/regular_file.h"
#include "runtime/scene/description/cube_name.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/memory_file.h"

namespace kinora {

namespace {

constexpr const char* kOutside =
    "it lies outside the scene's folder (--allow-external DIR lets it be read)";

std::unique_ptr<StoredImage> read_image(const std::string& name, const std::string& path,
                                        bool outside, bool data) {
    auto image = std::make_unique<StoredImage>();
    image->path = name;
    image->file = path;
    TextureImage pixels;
    image->error = outside ? kOutside : read_texture_image(path, pixels);
    if (image->error.empty()) {
        try {
            image->pyramid = TexturePyramid(pixels, pixels.encoded && !data);
            image->facts = pixels.facts;
            image->by_module = pixels.by_module;
            if (pixels.height == 6 * pixels.width)
                for (int face = 0; face < 6; ++face)
                    image->faces.emplace_back(image_rows(pixels, face * pixels.width, pixels.width),
                                              pixels.encoded && !data);
        } catch (const std::bad_alloc&) {
            image->error = "not enough memory";
        }
    }
    if (!image->error.empty()) image->pyramid = TexturePyramid(checks_image(), false);
    return image;
}

AllowedPaths::Found find_file(const AllowedPaths& trees, const std::string& name) {
    return is_memory_file(name) ? AllowedPaths::Found{name} : trees.find(name);
}

// A cube whose pictures may be of any sizes. One that cannot be read spoils it.
std::unique_ptr<StoredImage> read_cube(const std::string& path, const CubeName& name,
                                       const AllowedPaths& trees, bool data) {
    auto cube = std::make_unique<StoredImage>();
    cube->path = cube->file = path;
    cube->face_extent = float(std::tan(radians(std::clamp(name.fov, 1.0, 179.0)) / 2));
    for (const std::string& face : name.faces) {
        AllowedPaths::Found file = find_file(trees, face);
        std::unique_ptr<StoredImage> image = read_image(face, file.path, file.outside, data);
        if (!image->error.empty()) image->faces.clear();
        if (!image->error.empty()) return image;
        cube->facts = image->facts;
        cube->by_module = image->by_module;
        cube->faces.push_back(std::move(image->pyramid));
    }
    cube->facts.type = "environment";
    return cube;
}

// The reader of the scene says so of files its <image> elements name, the compiler of literals.
bool known_missing(const Diagnostics& diagnostics, const std::string& path) {
    for (const Finding& finding : diagnostics.findings())
        if ((finding.info == &collada::Code::FILE_MISSING ||
             finding.info == &collada::Code::LINK_OUTSIDE ||
             finding.info == &rsl::Code::RSL_FILE_OUTSIDE) &&
            finding.message.find("'" + path + "'") != std::string::npos)
            return true;
    return false;
}

}  // namespace

TextureStore::~TextureStore() {
    for (auto& chunk : chunks_) delete chunk.load();
}

TextureStore& TextureStore::process() {
    static TextureStore store;
    return store;
}

const Texture* TextureStore::find(int32_t name) {
    uint32_t chunk_index = uint32_t(name) >> kChunkBits;
    if (chunk_index < kChunks) {
        if (Chunk* chunk = chunks_[chunk_index].load(std::memory_order_acquire)) {
            uint32_t slot = uint32_t(name) & ((1u << kChunkBits) - 1);
            if (const Texture* known = (*chunk)[slot].load(std::memory_order_acquire)) return known;
        }
    }
    return name > 0 ? meet(name) : nullptr;
}

// Names beyond the last chunk are found by the map, under the lock.
const Texture* TextureStore::meet(int32_t name) {
    std::lock_guard lock(mutex_);
    std::unique_ptr<Texture>& texture = textures_[name];
    if (!texture) {
        TextureName modes = parse_texture_name(rsl::interned(name));
        texture = std::make_unique<Texture>(modes, image(modes.path, modes.data));
        if (!texture->image->error.empty()) texture->modes.nearest = true;  // sharp checks
    }
    uint32_t chunk_index = uint32_t(name) >> kChunkBits;
    if (chunk_index < kChunks) {
        Chunk* chunk = chunks_[chunk_index].load(std::memory_order_relaxed);
        if (!chunk) {
            chunk = new Chunk{};
            chunks_[chunk_index].store(chunk, std::memory_order_release);
        }
        uint32_t slot = uint32_t(name) & ((1u << kChunkBits) - 1);
        (*chunk)[slot].store(texture.get(), std::memory_order_release);
    }
    return texture.get();
}

// The mutex is held.
const StoredImage* TextureStore::image(const std::string& name, bool data) {
    std::optional<CubeName> cube = parse_cube_name(name);
    AllowedPaths::Found file = cube ? AllowedPaths::Found{name} : find_file(trees_, name);
    data = data || !decode_;
    std::unique_ptr<StoredImage>& known = images_[{file.path, data}];
    if (!known)
        known = cube ? read_cube(name, *cube, trees_, data)
                     : read_image(name, file.path, file.outside, data);
    return known.get();
}

void TextureStore::preload(std::span<const std::string> names) {
    std::set<std::pair<std::string, bool>> wanted;
    {
        std::lock_guard lock(mutex_);
        for (auto& [key, image] : images_) image->reported = false;
        for (const std::string& name : names) {
            TextureName parsed = parse_texture_name(name);
            auto [path, outside] = find_file(trees_, parsed.path);
            bool there = !outside && (is_regular_file(path) || is_memory_file(path));
            bool data = parsed.data || !decode_;
            if (there && !images_.count({path, data})) wanted.emplace(path, data);
        }
    }
    // Read without the lock: a worker that waits for it could hold up the one that owns it.
    std::vector<std::pair<std::string, bool>> keys(wanted.begin(), wanted.end());
    std::vector<std::unique_ptr<StoredImage>> read(keys.size());
    parallel_for(0, keys.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            read[i] = read_image(keys[i].first, keys[i].first, false, keys[i].second);
    });
    std::lock_guard lock(mutex_);
    for (size_t i = 0; i < keys.size(); ++i) images_.try_emplace(keys[i], std::move(read[i]));
}

void TextureStore::report(Diagnostics& diagnostics) {
    std::lock_guard lock(mutex_);
    const std::string* last = nullptr;  // both decodings of a path are neighbours
    for (auto& [key, image] : images_) {
        if (image->error.empty() || !image->asked.load(std::memory_order_relaxed)) continue;
        bool known = image->reported || (last && *last == image->path);
        image->reported = true;
        last = &image->path;
        if (!known && !known_missing(diagnostics, image->path))
            diagnostics.report(Code::IMAGE_UNREADABLE, Location{}, image->path, image->error);
    }
}

void TextureStore::each_image(const std::function<void(const StoredImage&)>& see) const {
    std::lock_guard lock(mutex_);
    for (const auto& [key, image] : images_) see(*image);
}

int TextureStore::images() const {
    std::lock_guard lock(mutex_);
    return int(images_.size());
}

uint64_t TextureStore::decoded_bytes() const {
    uint64_t bytes = 0;
    each_image([&](const StoredImage& image) {
        bytes += image.pyramid.bytes();
        for (const TexturePyramid& face : image.faces) bytes += face.bytes();
    });
    return bytes;
}

}  // namespace kinora
