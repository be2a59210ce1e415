// rsl/text/did_you_mean.h: what a name that nobody knows is most likely to mean.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinora::rsl {

// Whether they differ by the case of ASCII letters at most.
bool same_letters(std::string_view a, std::string_view b);

// Of the names, the one that a wrong one is probably meant to be: it differs in the case of letters
// alone, else in one or two letters, else only in its end. "" if there is none.
std::string_view did_you_mean(std::string_view word, const std::vector<std::string_view>& names);

// "did you mean 'diffuse'?", or "".
std::string meant_help(std::string_view word, const std::vector<std::string_view>& names);

}  // namespace kinora::rsl
