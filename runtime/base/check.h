// runtime/base/check.h: checks of ourselves. A failed CHECK is a bug in Kinora, never bad input. It
// throws, so that a program which uses the library loses one scene and not itself.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace kinora {

// What a failed CHECK throws; what() is "file:line: CHECK failed: text".
class CheckFailed : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

[[noreturn]] void check_failed(const char* file, int line, const std::string& text);

template <class A, class B>
std::string check_text(const char* expression, const A& a, const B& b) {
    std::ostringstream out;
    out << expression << " (" << a << " vs " << b << ")";
    return out.str();
}

}  // namespace kinora

#define CHECK(condition)                                            \
    do {                                                            \
        if (!(condition)) [[unlikely]]                              \
            ::kinora::check_failed(__FILE__, __LINE__, #condition); \
    } while (0)

#define KINORA_CHECK_OP(a, op, b)                                                              \
    do {                                                                                       \
        const auto& check_a = (a);                                                             \
        const auto& check_b = (b);                                                             \
        if (!(check_a op check_b)) [[unlikely]]                                                \
            ::kinora::check_failed(__FILE__, __LINE__,                                         \
                                   ::kinora::check_text(#a " " #op " " #b, check_a, check_b)); \
    } while (0)

#define CHECK_EQ(a, b) KINORA_CHECK_OP(a, ==, b)
#define CHECK_NE(a, b) KINORA_CHECK_OP(a, !=, b)
#define CHECK_LT(a, b) KINORA_CHECK_OP(a, <, b)
#define CHECK_LE(a, b) KINORA_CHECK_OP(a, <=, b)
#define CHECK_GT(a, b) KINORA_CHECK_OP(a, >, b)
#define CHECK_GE(a, b) KINORA_CHECK_OP(a, >=, b)
