// runtime/scene/description/texture_name.h: a file and the way it is looked up, as the one string a
// shader handles.
//
// RSL knows a texture by its name. Wrap, border, repeat and filter belong to COLLADA's <sampler>;
// they travel in the string behind the path so that pixels stay shared by path. A plain path is a
// valid name: it wraps, filters linearly and is colour (8-bit pixels are decoded from sRGB).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace kinora {

enum class TextureWrap : uint8_t { Wrap, Mirror, Clamp, Border };
// From the fastest.
enum class TextureFilter : uint8_t {
    Nearest,      // the texel at s, t
    Bilinear,     // four texels of the finest level
    Trilinear,    // two levels at the longer side of the footprint
    Anisotropic,  // up to 16 trilinear lookups along the longer side, at the shorter's level
};
enum class TextureMip : uint8_t { Linear, Nearest, None };  // between levels; None: the finest

struct TextureName {
    std::string path;
    TextureWrap wrap_s = TextureWrap::Wrap;
    TextureWrap wrap_t = TextureWrap::Wrap;
    bool nearest = false;            // no filtering at all
    bool nearest_magnified = false;  // none where texels are larger than pixels
    bool nearest_minified = false;   // none where they are smaller
    TextureMip mip = TextureMip::Linear;
    float mip_bias = 0;         // added to the level
    uint8_t mip_max_level = 0;  // the coarsest used; 0 is all
    bool data = false;          // bump, masks: never decoded from sRGB
    std::array<float, 4> border{0, 0, 0, 0};
    std::array<float, 2> turn{1, 0};      // cosine, sine: s, t turn about (1/2, 1/2) first
    std::array<float, 4> uv{1, 1, 0, 0};  // then s' = s * uv[0] + uv[2], t' = t * uv[1] + uv[3]
};

std::string texture_name_string(const TextureName& name);  // the bare path when all is default
// The other way round; a plain path has the defaults.
TextureName parse_texture_name(std::string_view text);

// How it is looked up in words that a file can hold: "data,clamp_s,mirror_t,nearest"; "" when all
// is default. Nothing where words do not say it (turned, repeated, with a border's color).
std::optional<std::string> texture_words(const TextureName& name);
// Sets what the words say; false if one of them is unknown.
bool set_texture_words(std::string_view words, TextureName& name);

}  // namespace kinora
