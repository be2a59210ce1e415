// runtime/programs/tradeoff/tradeoff.cpp: the files of a trade-off, and what a terminal shows.
#include "runtime/programs/tradeoff/tradeoff.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "runtime/base/files/temporary_file.h"
#include "runtime/programs/common/exit_codes.h"

namespace kinora {

namespace {

int unwritable_code(const std::string& path, int number) {
    std::fprintf(stderr, "kinora-render: error: cannot write '%s': %s\n", path.c_str(),
                 std::strerror(number));
    return number == ENOSPC || number == EDQUOT ? kExitRetry : kExitUnwritable;
}

int write_whole(const std::string& path, const std::string& text) {
    const int number = write_whole_file(path, text);
    return number ? unwritable_code(path, number) : int(kExitOk);
}

}  // namespace

int try_tradeoff_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!std::filesystem::is_directory(folder, error))
        return unwritable_code(folder, error ? error.value() : ENOTDIR);
    return ::access(folder.c_str(), W_OK) == 0 ? int(kExitOk) : unwritable_code(folder, errno);
}

int write_tradeoff(const TradeResults& results, const std::string& folder) {
    if (int code = try_tradeoff_folder(folder)) return code;
    const std::filesystem::path path(folder);
    if (int code = write_whole(path / "tradeoff.json", tradeoff_json(results))) return code;
    if (int code = write_whole(path / "tradeoff.csv", tradeoff_csv(results))) return code;
    return write_whole(path / "tradeoff.html", tradeoff_html(results));
}

std::string tradeoff_text(const TradeResults& r) {
    std::string text = fmt::format("{:<28} {:>10} {:>10} {:>10} {:>10}\n", "", "CPU ms", "FLIP",
                                   "HDR-FLIP", "RMSE");
    auto error = [&](const char* name, const TradeRow& row) {
        return error_text(*find_trade_metric(name), row, r.floor);
    };
    for (const TradeRow& row : r.rows) {
        if (row.variant.kind != VariantKind::Preset || !row.measured()) continue;
        text += fmt::format("{:<28} {:>10.4g} {:>10} {:>10} {:>10}\n", row.variant.name,
                            row.times.ms.median, error("flip", row), error("hdr_flip", row),
                            error("rmse", row));
        if (row.off_front > kMostOffFront)
            text += fmt::format("  off the front by {:.0f} %\n", 100 * row.off_front);
    }
    size_t measured = 0, other = 0, as_base = 0;
    for (const TradeRow& row : r.rows) {
        measured += row.measured();
        as_base += row.as_base;
        other += row.measured() && row.variant.kind == VariantKind::Knob && row.same_picture;
    }
    return text + fmt::format(
                      "{} of {} variants measured in {:.1f} s of {:g} s; {} others do nothing "
                      "here; {} knobs' settings have the bits of their base's pictures\n",
                      measured, r.rows.size(), r.used_s, r.budget_s, as_base, other);
}

}  // namespace kinora
