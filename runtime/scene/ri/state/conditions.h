// runtime/scene/ri/state/conditions.h: the expressions of IfBegin and ElseIf.
//
// expression := or            or := and { "||" and }       and := equal { "&&" equal }
// equal := order { ("==" | "!=") order }     order := sum { ("<" | "<=" | ">" | ">=") sum }
// sum := product { ("+" | "-") product }     product := unary { ("*" | "/" | "%") unary }
// unary := ("!" | "-") unary | "(" or ")" | number | 'text' | $name | ${name} | defined(name)
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace kinora::ri {

// A number or a text. A text is true where it is not empty, and no number is equal to it.
struct ConditionValue {
    std::optional<std::string> text;
    double number = 0;

    bool is_true() const { return text ? !text->empty() : number != 0; }
};

// What a name without its $ stands for; nothing: nobody has set it.
using ConditionLookup = std::function<std::optional<ConditionValue>(std::string_view name)>;

// Nothing: it cannot be read; `why` says where. Names that nobody has set are 0, and `unknown` is
// told the first outside of defined().
struct Condition {
    std::optional<bool> value;
    std::string why, unknown;
};
Condition evaluate_condition(std::string_view expression, const ConditionLookup& lookup);

}  // namespace kinora::ri
