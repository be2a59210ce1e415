// runtime/programs/shade/points_lights.h: the lights of --points: their shaders, run where surfaces
// are lit.
#pragma once

#include <memory>

#include "runtime/programs/shade/points_kernel.h"
#include "runtime/programs/shade/source.h"

namespace kinora {

class PointsHost;

class PointsLights {
  public:
    // Reads and checks the sources. Returns an exit code where one has errors (said on stderr);
    // throws PointsError where parameters do not fit.
    std::optional<int> open(const ShadeOptions& options, const PointSet& points);
    // Compiles them for a surface: with the messages that it reads. False: findings were printed.
    bool bind(const ShadeOptions& options, const rsl::LoweredShader& surface);

    // Records at the points, and at the positions of a call of the service `lights`.
    jit::RecordSet at_points(const PointSet& points, PointsHost& host, Arena& arena);
    jit::RecordSet at_lanes(const PointSet& points, const jit::ServiceCall& call, PointsHost& host,
                            Arena& arena);
    void report(const ShadeOptions& options);
    // A parameter as it is bound, or its constant default; nothing where light `light` has none.
    std::optional<PointsValue> parameter(int32_t light, const std::string& name) const;

  private:
    struct Light {
        int32_t number = 0;
        const PointsShader* from = nullptr;
        ShadeSource source;
        PointsStack stack;
        std::unique_ptr<PointsKernel> kernel;
    };
    // Rows of P, then of N.
    jit::RecordSet run(const PointSet& points, const std::span<const float> (&rows)[6],
                       size_t count, size_t first, PointsHost& host, Arena& arena);
    void add_records(const Light& light, std::span<float* const> out, size_t count, size_t first,
                     Arena& arena, std::vector<jit::Record>& records) const;
    double number(const Light& light, const char* name) const;  // of a parameter; 0: none
    std::string category(const Light& light) const;

    std::vector<std::unique_ptr<Light>> lights_;
    const rsl::LoweredShader* surface_ = nullptr;
    bool running_ = false;  // a light asks for no lights
};

}  // namespace kinora
