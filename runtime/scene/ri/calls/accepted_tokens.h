// runtime/scene/ri/calls/accepted_tokens.h: arguments that are one of a few words.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene/ri/calls/call.h"

namespace kinora::ri {

struct AcceptedTokens {
    Request request;
    size_t argument;
    std::span<const std::string_view> words;  // of 3.2
    std::span<const std::string_view> other;  // that renderers and their files have besides
    std::string_view otherwise;               // what is done with any other word
    bool left_out;                            // the request is; else it is done with a default
};
std::span<const AcceptedTokens> accepted_tokens();

// "bilinear, bicubic".
std::string words_of(const AcceptedTokens& row);

struct WrongToken {
    const AcceptedTokens* row;
    std::string_view token;
};
std::vector<WrongToken> wrong_tokens(Request request, std::span<const Values> arguments);
// The one for which a primitive is left out: without it its values cannot be counted.
std::optional<WrongToken> refusal(Request request, std::span<const Values> arguments);

}  // namespace kinora::ri
