// runtime/scene/ri/state/shader_linker.h: shaders as they are bound: compiled for the lengths of
// their arrays, and with the co-shaders that they can find.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rsl/link.h"
#include "runtime/scene/ri/state/graphics_state.h"
#include "runtime/scene/ri/state/shader_search.h"

namespace kinora::ri {

class ShaderLinker {
  public:
    ShaderLinker(const ShaderSearch& search, Diagnostics& diagnostics)
        : search_(search), diagnostics_(diagnostics) {}

    // Makes the binding's shader one with those of the co-shaders that it can mean. Their arguments
    // become its own, as "HANDLE.NAME", in its space. After an error, which is a finding, it stays
    // alone.
    void link(ShaderBinding& binding, std::span<const CoShader> co_shaders);

  private:
    using Made = std::shared_ptr<const rsl::Shader>;
    rsl::LinkedSource source(const ShaderBinding& binding, const std::string& handle) const;
    Made linked(const ShaderBinding& binding, std::span<const CoShader> meant);

    const ShaderSearch& search_;
    Diagnostics& diagnostics_;
    std::map<std::string, Made> linked_;  // by what decides it
};

}  // namespace kinora::ri
