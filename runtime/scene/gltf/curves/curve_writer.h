// runtime/scene/gltf/curves/curve_writer.h: curves as glTF's channels and samplers: exact where
// it has them, else sampled.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "runtime/scene/curves/channels.h"
#include "runtime/scene/curves/reduce_keys.h"
#include "runtime/scene/gltf/curves/takes.h"
#include "runtime/scene/gltf/document/buffer_writer.h"
#include "runtime/scene/gltf/document/loss_report.h"

namespace kinora {

// A property of a node over time, or any value of the file by its JSON pointer
// (KHR_animation_pointer), and how near its keys must come.
struct PropertyCurve : Curve {
    std::string name;  // glTF's path: "translation", "weights"; or "/materials/0/alphaCutoff"
    std::vector<MovingChannel> channels;
    double tolerance = 1e-4;
    std::vector<double> times;  // keys of the channels, more where they turn far

    bool is_pointer() const { return name.starts_with('/'); }
    uint32_t element_width() const;  // of its accessor
};

class CurveWriter {
  public:
    // `error` is GltfExportOptions::animation_error.
    CurveWriter(std::span<const Take> takes, double error, GltfDocument& document,
                BufferWriter& buffer);
    ~CurveWriter();

    // `node` is kNone for a pointer, whose value is already in the document. A curve that stays
    // where it is needs no keys: it is written into the document, or is one key where another take
    // may move the value elsewhere.
    void add(uint32_t take, uint32_t node, PropertyCurve curve);

    // Cubics whose inner times are the thirds are cubics of the time: tangents are three times the
    // legs over the duration. False where the channels are none with the same keys, which write
    // values from first_value on.
    bool add_spline(uint32_t take, uint32_t node, const PropertyCurve& curve, uint32_t first_value);

    // Adds an animation to the document for each take that has channels.
    void write_animations();
    void report(LossReport& losses) const;  // what was sampled
    bool has_channels(uint32_t take) const;

  private:
    struct Output;  // channels and samplers of a take
    bool add_step(uint32_t take, uint32_t node, const PropertyCurve& curve);
    void add_still(uint32_t take, uint32_t node, const PropertyCurve& curve,
                   const std::vector<double>& numbers, double tolerance);
    void add_sampled(uint32_t take, uint32_t node, const PropertyCurve& curve);
    void add_channel(uint32_t take, uint32_t node, const PropertyCurve& curve,
                     const std::vector<double>& times, const std::vector<double>& numbers,
                     const char* interpolation);

    std::span<const Take> takes_;
    double error_;
    GltfDocument& document_;
    BufferWriter& buffer_;
    std::vector<Output> outputs_;                            // per take
    std::map<std::vector<double>, uint32_t> key_accessors_;  // of times
    double worst_error_ = 0;
    uint32_t sampled_ = 0;
};

}  // namespace kinora
