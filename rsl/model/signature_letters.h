// rsl/model/signature_letters.h: the signatures of built-ins, checked while their rows are
// compiled.
#pragma once

#include <string_view>

namespace kinora::rsl {

inline constexpr std::string_view kSignatureTypes = "fcpvnms?";  // rsl/model/builtin.h

// Functions without bodies: the compiler names the one that a wrong signature calls.
#define KINORA_LETTERS_OF_NO_TYPE(X) \
    X(a) X(b) X(d) X(e) X(g) X(h) X(i) X(j) X(k) X(l) X(o) X(q) X(r) X(t) X(u) X(w) X(y) X(z)
#define KINORA_NO_TYPE(letter) void no_type_has_the_letter_##letter();
KINORA_LETTERS_OF_NO_TYPE(KINORA_NO_TYPE)
#undef KINORA_NO_TYPE
void a_signature_has_an_unknown_sign();
void a_signature_has_x_as_an_argument();
void a_signature_begins_with_a_result_and_an_equals_sign();
void a_signature_has_a_sign_behind_no_argument();
void a_signature_has_a_sign_before_its_end();

constexpr char lower_case(char letter) {
    return letter >= 'A' && letter <= 'Z' ? char(letter - 'A' + 'a') : letter;
}

constexpr void check_type(char letter) {
#define KINORA_NO_TYPE(wrong) \
    if (letter == #wrong[0]) no_type_has_the_letter_##wrong();
    KINORA_LETTERS_OF_NO_TYPE(KINORA_NO_TYPE)
#undef KINORA_NO_TYPE
    if (letter == 'x') a_signature_has_x_as_an_argument();
    if (kSignatureTypes.find(letter) == std::string_view::npos) a_signature_has_an_unknown_sign();
}

// What stands behind "result=".
constexpr void check_arguments(std::string_view text) {
    for (size_t i = 0; i < text.size(); ++i) {
        std::string_view rest = text.substr(i);
        bool array = rest.starts_with("[]"), repeats = rest[0] == '*', pairs = rest[0] == '~';
        if ((array || repeats) && i == 0) a_signature_has_a_sign_behind_no_argument();
        if (pairs && rest.size() > 1) a_signature_has_a_sign_before_its_end();
        if (repeats && rest.size() > 1 && rest != "*~") a_signature_has_a_sign_before_its_end();
        if (!array && !repeats && !pairs) check_type(lower_case(rest[0]));
        i += array;
    }
}

// Overloads, parted by spaces.
constexpr void check_signatures(std::string_view text) {
    while (!text.empty()) {
        size_t end = text.find(' ') < text.size() ? text.find(' ') : text.size();
        std::string_view signature = text.substr(0, end);
        if (signature.size() < 2 || signature[1] != '=')
            a_signature_begins_with_a_result_and_an_equals_sign();
        if (signature[0] != 'x') check_type(signature[0]);
        check_arguments(signature.substr(2));
        text.remove_prefix(end < text.size() ? end + 1 : end);
    }
}

}  // namespace kinora::rsl
