// tests/rsl/reduce_text.h: makes a failing source small while it still fails.
#pragma once

#include <functional>
#include <string>

namespace kinora::rsl {

// Drops blocks, the braces around them, runs of lines, and parts of lines in parentheses, as long
// as `fails` holds of what is left; at most `trials` questions.
std::string reduce_text(std::string text, const std::function<bool(const std::string&)>& fails,
                        int trials = 4000);

}  // namespace kinora::rsl
