// runtime/programs/shade/run.cpp: a grid of points through a shader to a picture.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <limits>

#include "runtime/base/stats.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/shade/compare.h"
#include "runtime/scene/images/image_io.h"
#include "runtime/scene/images/texture.h"

namespace kinora {

namespace {

// The output's columns: three, or one for a float.
std::vector<std::string> columns_of(const std::string& output, const ShadeOutputs& outputs) {
    using rsl::ComponentForm;
    auto names = [&](auto&& key, int count) {
        std::vector<std::string> all;
        for (int k = 0; k < count; ++k) all.push_back(rsl::text(key(k)));
        return outputs.count(all[0]) ? all : std::vector<std::string>();
    };
    if (const rsl::GlobalInfo* global = rsl::find_global(output)) {
        auto key = [&](int k) { return rsl::global_key(global->id, k); };
        auto found = names(key, rsl::component_count(global->type.base));
        if (!found.empty()) return found;
    }
    for (const auto& [parameter, element] : {std::pair(output, -1), output_element(output)})
        for (ComponentForm form :
             {ComponentForm::Single, ComponentForm::Color, ComponentForm::Triple}) {
            auto key = [&](int k) { return rsl::aov_key(parameter, element, form, k); };
            auto found = names(key, form == ComponentForm::Single ? 1 : 3);
            if (!found.empty()) return found;
        }
    return {};
}

raytrace::Film picture(const ShadeOptions& options, const ShadeOutputs& outputs,
                       const std::vector<std::string>& names, const Patch& patch) {
    raytrace::Film film(options.width, options.height);
    bool has_alpha = options.output == "Ci" && outputs.count("Oi.r");
    for (size_t i = 0; i < patch.count(); ++i) {
        vec4& pixel = film.rgba[patch[i].pixel];
        for (size_t k = 0; k < 3; ++k)
            pixel[int(k)] = outputs.at(names[std::min(k, names.size() - 1)])[i];
        pixel.w = 1;
        if (has_alpha)
            pixel.w = (outputs.at("Oi.r")[i] + outputs.at("Oi.g")[i] + outputs.at("Oi.b")[i]) / 3;
    }
    return film;
}

void print_ranges(const ShadeOutputs& outputs, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        float low = std::numeric_limits<float>::infinity(), high = -low;
        double sum = 0;
        size_t odd = 0;
        const std::vector<float>& values = outputs.at(name);
        for (float x : values) {
            if (!std::isfinite(x)) {
                ++odd;
                continue;
            }
            low = std::min(low, x);
            high = std::max(high, x);
            sum += double(x);
        }
        std::printf("%-8s %.6g to %.6g, mean %.6g", name.c_str(), double(low), double(high),
                    sum / double(std::max<size_t>(1, values.size() - odd)));
        if (odd) std::printf(", %zu not finite", odd);
        std::printf("\n");
    }
}

int write_picture(const ShadeOptions& options, const raytrace::Film& film) {
    int number = 0;
    bool color = options.output == "Ci" || options.output == "Oi";
    std::string error = write_image_and_folder(
        options.file, film, color ? ColorEncoding::Srgb : ColorEncoding::Linear,
        {{"Software", "kinora-shade " KINORA_VERSION}}, &number);
    if (error.empty()) return kExitOk;
    std::fprintf(stderr, "kinora-shade: cannot write '%s': %s\n", options.file.c_str(),
                 error.c_str());
    return number == ENOSPC || number == EDQUOT ? kExitRetry : kExitUnwritable;
}

double run_best(const ShadeOptions& options, ShadeKernel& kernel) {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < std::max(1, options.iterations); ++i) {
        Stopwatch watch;
        kernel.run();
        best = std::min(best, watch.ms());
    }
    return best;
}

}  // namespace

int shade_run(const ShadeOptions& options) {
    if (!options.points.empty()) return shade_points(options);
    ShadeSource source;
    Patch patch(options.width, options.height, options.sphere);
    ShadeStack stack;
    if (std::optional<int> code = open_stack(options, source, patch, stack)) return *code;
    const rsl::Shader* shader = stack.layers.front().shader;
    ShadeKernel kernel;
    if (!kernel.compile(stack, options.target, source.diagnostics)) {
        source.print_findings(options);
        return kExitShader;
    }
    kernel.bind(stack, patch);
    double ms = run_best(options, kernel);
    kernel.report_faults(source.diagnostics);
    patch.textures->report(source.diagnostics);
    source.print_findings(options);
    for (const std::string& space : kernel.unknown_spaces())
        if (options.verbose)
            std::fprintf(stderr,
                         "kinora-shade: there is no scene that has a coordinate system '%s': here "
                         "it is the world\n",
                         space.c_str());
    ShadeOutputs outputs = stack.light ? kernel.illumination() : kernel.outputs();
    std::vector<std::string> names = columns_of(options.output, outputs);
    if (!options.quiet) {
        std::printf("%s %s on %s: %zu points in %.3f ms, %.2f Mpoints/s\n",
                    rsl::shader_kind_name(shader->kind), shader->name.c_str(),
                    kernel.pair().point->target, patch.count(), ms,
                    double(patch.count()) / ms * 1e-3);
        print_ranges(outputs, names);
    }
    if (options.compare == "interp")
        compare_with_interpreter(stack, patch, kernel, source.diagnostics);
    if (options.compare == "reference") compare_with_reference(stack, patch, kernel);
    if (options.file.empty()) return source.exit_code(options, kExitOk);
    if (names.empty()) {
        std::fprintf(stderr, "kinora-shade: the shader never sets %s\n", options.output.c_str());
        return kExitUsage;
    }
    return source.exit_code(options,
                            write_picture(options, picture(options, outputs, names, patch)));
}

}  // namespace kinora
