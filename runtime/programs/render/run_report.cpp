// runtime/programs/render/run_report.cpp: frames counted and named by what became of them.
#include "runtime/programs/render/run_report.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

#include "runtime/kinora/frame_list.h"

namespace kinora {

namespace {

bool is_there(FrameState state) {
    return state == FrameState::Done || state == FrameState::Kept;
}

std::string named(const FrameTimes& frames, const std::vector<FrameRecord>& records,
                  FrameState state) {
    std::vector<int64_t> numbers;
    for (size_t i = 0; i < frames.size(); ++i)
        if ((i < records.size() ? records[i].state : FrameState::Aborted) == state)
            numbers.push_back(frames[i].first);
    if (numbers.empty()) return "";
    return fmt::format("; {}: {}", frame_state_name(state), frame_ranges(std::move(numbers)));
}

size_t count_there(const std::vector<FrameRecord>& records) {
    return size_t(std::ranges::count_if(records, is_there, &FrameRecord::state));
}

bool is_whole_file(const std::string& file) {
    struct stat status {};
    return stat(file.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0;
}

}  // namespace

const char* frame_state_name(FrameState state) {
    switch (state) {
        case FrameState::Aborted:
            return "aborted";
        case FrameState::Done:
            return "done";
        case FrameState::Kept:
            return "kept";
        case FrameState::Failed:
            return "failed";
    }
    return "";
}

bool all_frames_there(const FrameTimes& frames, const std::vector<FrameRecord>& records) {
    return count_there(records) == frames.size();
}

std::string frames_text(const FrameTimes& frames, const std::vector<FrameRecord>& records) {
    return fmt::format("{} of {} frames", count_there(records), frames.size()) +
           named(frames, records, FrameState::Failed) + named(frames, records, FrameState::Aborted);
}

std::vector<std::string> mark_lost_frames(std::vector<FrameRecord>& records) {
    std::vector<std::string> lost;
    for (FrameRecord& record : records) {
        if (record.file.empty() || !is_there(record.state) || is_whole_file(record.file)) continue;
        record.state = FrameState::Failed;
        lost.push_back(record.file);
    }
    return lost;
}

bool folder_is_there(const std::string& file) {
    std::error_code ignored;
    const auto folder = std::filesystem::path(file).parent_path();
    return folder.empty() || std::filesystem::is_directory(folder, ignored);
}

}  // namespace kinora
