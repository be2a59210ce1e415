// rsl/model/builtin.h: the table of built-in functions: one row has the signatures, the lowering,
// the reference meaning, the effects and the documentation of one function. Everything about
// built-ins (overload resolution, rates, manual, random-shader generator, row tests) follows from
// the rows.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "rsl/model/signature_letters.h"
#include "rsl/syntax/types.h"

namespace kinora::rsl {

// What specular() takes a smaller roughness for: a division by 0 gives 0
// (docs/numerics.md#division), and x^0 would light the whole front of what shines in one direction
// only.
constexpr float kLeastRoughness = 1e-6f;

struct LowerCall;  // rsl/lower: arguments in, IR values out
template <class Real>
struct RefCall;  // rsl/reference: arguments in, numbers out; Real = float or double

using LowerFn = void (*)(LowerCall&);

// One template in C++, two instantiations: float checks meaning, double measures accuracy.
struct RefFn {
    void (*single)(RefCall<float>&) = nullptr;
    void (*precise)(RefCall<double>&) = nullptr;
};
#define KINORA_RSL_REF(function) (::kinora::rsl::RefFn{&function<float>, &function<double>})

// Effects: what the result depends on beside the arguments, and what is done beside returning.
enum Effects : uint32_t {
    kPure = 0,
    kVaryingResult = 1 << 0,  // differs from point to point whatever the arguments (random, lights)
    kDerivative = 1 << 1,     // takes derivatives of its arguments: result varying if they are
    kService = 1 << 2,        // calls RendererServices
    kLights = 1 << 3,         // reads the light records at P
    kTraces = 1 << 4,         // shoots rays (shadow included)
    kPrints = 1 << 5,         // visible outside: never removed, never hoisted (also baking)
    kMessage = 1 << 6,        // reads another shader or the renderer's state
    kShadows = 1 << 7,        // its presence in a light switches automatic shadows off
                              // (docs/decisions.md#automatic-shadows)
    kUniformOnly = 1 << 8,    // all inputs must be uniform
    kReadsChannels =
        1 << 9,  // pairs name channels and the variables they are put in (rsl/model/pairs.h)
    kNamesFile = 1 << 10,       // the first argument, if a string, is a file
    kWritesChannels = 1 << 11,  // pairs name channels and the values they are given
    kNamesPoints = 1 << 13,     // that file is a point file, else a picture
    kConstantResult = 1 << 12,  // known when the shader is compiled, whatever the arguments
    kReadsLength = 1 << 14,     // the result is an array's length, whatever its elements are
    kSetsLength = 1 << 15,      // changes the length of its first argument, a resizable array
    kForHeaders = 1 << 16,      // called by our own headers and by what calls of handles become
    kSendsSamples = 1 << 17,    // its presence in a light makes records of what it sends
};

// Shader kinds that may call the function.
enum LegalIn : uint8_t {
    kSurface = 1,
    kDisplacement = 2,
    kLight = 4,
    kVolume = 8,
    kImager = 16,
    kTransformation = 32,
    kAnyShader = 63,
};

// Whether a function of that name, a class's, a struct's or a co-shader's, makes samples. Names
// have prefixes of owners and suffixes of struct arguments.
inline bool is_sample_method(std::string_view name) {
    return name.find("generateSamples") != name.npos;
}

// A row. `signature` holds overloads separated by spaces, best first: result '=' arguments, in
// letters f c p v n m s (float color point vector normal matrix string), x = void (result only),
// ? = any type, capitals = output arguments, and after a letter:
//   []  an array of it, any length
//   *   (last only) the letter before repeats, zero or more times: "f=fff*" is two floats or more
//   ~   (last only) then any number of pairs: constant string, any value ("blur", 0.1)
// An overload wanting `f` takes constants, Bools too (as 0/1); wanting a triple takes any triple
// or a float (spread); `m` takes a float (diagonal). Calls to a row whose `lower` is null are
// reported as not supported yet.
struct Builtin {
    const char* name;
    const char* signature;
    LowerFn lower;
    RefFn ref;
    uint32_t effects;     // Effects
    int tolerance_ulp;    // largest error of the precise tier against the reference in double
    const char* doc;      // one line for the manual
    uint8_t legal;        // LegalIn
    const char* globals;  // shader globals read beside the arguments, space separated: "Ng"

    // A row with a malformed signature does not compile: the message has the row's name and letter
    // (rsl/model/signature_letters.h).
    consteval Builtin(const char* row_name, const char* row_signature, LowerFn row_lower,
                      RefFn row_ref, uint32_t row_effects, int row_tolerance_ulp,
                      const char* row_doc, uint8_t row_legal = kAnyShader,
                      const char* row_globals = "")
        : name(row_name),
          signature(row_signature),
          lower(row_lower),
          ref(row_ref),
          effects(row_effects),
          tolerance_ulp(row_tolerance_ulp),
          doc(row_doc),
          legal(row_legal),
          globals(row_globals) {
        check_signatures(row_signature);
    }
};

// One overload, decoded.
struct Signature {
    struct Argument {
        Type type;            // base Invalid = any type
        bool output = false;  // an l-value that the function writes
    };
    Type result;
    std::vector<Argument> arguments;  // a repeated last argument is not among them
    bool repeats = false;             // `*`: any number of `repeated` follow
    Argument repeated;
    bool pairs = false;  // `~`
    int overload = 0;    // its index in Builtin::signature
};

struct Overload {
    const Builtin* builtin;
    Signature signature;
};

}  // namespace kinora::rsl
