// rsl/lower/context.h: what a kernel is lowered from and for: the stack of layers and the one that
// is being written, the options, what is found out about the kernel, and reports to the user.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "rsl/lower/lower.h"
#include "rsl/lower/math.h"
#include "rsl/syntax/ast.h"
#include "rsl/text/findings.h"

namespace kinora::rsl {

class LoweringContext {
  public:
    LoweringContext(std::span<const Layer> stack, const LowerOptions& lower_options,
                    Diagnostics& sink, LoweredShader& result)
        : layers(stack), options(lower_options), out(result), diagnostics_(sink) {}

    const std::span<const Layer> layers;  // the whole stack
    const LowerOptions& options;
    LoweredShader& out;
    const Layer* layer = nullptr;  // the one being written
    size_t layer_index = 0;
    bool failed = false;

    ShaderKind kind() const { return layer->shader->kind; }
    const Ast& ast() const { return *layer->shader->ast; }
    const ParamBinding* binding(std::string_view name) const {
        for (const ParamBinding& bound : layer->params)
            if (bound.name == name) return &bound;
        return nullptr;
    }
    // A displacement's "current" is the object's space. Where it is joined with surfaces, the
    // kernel's is the camera's: what it reads is brought over, and what it leaves is brought back.
    bool bends_normals() const {
        return kind() == ShaderKind::Displacement && !layer->done &&
               layers.back().shader->kind == ShaderKind::Surface;
    }

    // Null if that has been said of the source.
    template <class... Args>
    Finding* report(const FindingInfo& info, Location where, const Args&... args) {
        std::string message = fmt::vformat(info.text, fmt::make_format_args(args...));
        if (!ast().reported.first(diagnostics_, info, where, message)) return nullptr;
        return &diagnostics_.add(info, where, std::move(message));
    }
    // The same, once for the source wherever else it stands too.
    template <class... Args>
    Finding* report_first(const FindingInfo& info, Location where, const Args&... args) {
        std::string message = fmt::vformat(info.text, fmt::make_format_args(args...));
        if (!ast().reported.first(diagnostics_, info, {}, message)) return nullptr;
        return &diagnostics_.add(info, where, std::move(message));
    }
    template <class... Args>
    void error(const FindingInfo& info, Location where, const Args&... args) {
        report(info, where, args...);
        failed = true;
    }

  private:
    Diagnostics& diagnostics_;
};

// What needs the value of an expression or the code of a statement gets it here: the tree walker's
// face to the objects that it is made of.
class TreeWalk {
  public:
    virtual Lowered expr(const Expr& e) = 0;
    virtual void statement(const Stmt& stmt) = 0;
    virtual void block(std::span<Stmt* const> body) = 0;
    Value value(const Expr& e) { return expr(e).c[0]; }

  protected:
    ~TreeWalk() = default;
};

// While a function of the IR is written, an object that has values of the kernel around it begins
// anew: its State is put aside for the life of the guard.
template <class Object>
class Apart {
  public:
    explicit Apart(Object& object) : object_(object), outer_(object.enter_function()) {}
    ~Apart() { object_.leave_function(std::move(outer_)); }
    Apart(const Apart&) = delete;
    Apart& operator=(const Apart&) = delete;

  private:
    Object& object_;
    typename Object::State outer_;
};

}  // namespace kinora::rsl
