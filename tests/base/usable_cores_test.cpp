// tests/base/usable_cores_test.cpp: threads by affinity and by what control groups grant, read from
// folders that look as the kernel's do.
#include "runtime/base/tasks/usable_cores.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "runtime/base/parallel.h"

namespace kinora {
namespace {

namespace fs = std::filesystem;

class GrantedCores : public testing::Test {
  protected:
    GrantedCores()
        : root_(fs::path(testing::TempDir()) / ("kinora_cores_" + std::to_string(getpid()))) {
        fs::remove_all(root_);
    }
    ~GrantedCores() override { fs::remove_all(root_); }
    void write(const std::string& name, const std::string& text) {
        fs::create_directories((root_ / name).parent_path());
        std::ofstream(root_ / name) << text;
    }
    // Mounts a hierarchy and says which group the process is in.
    void unified(const std::string& group, const std::string& mounted = "/") {
        write("proc/self/mountinfo",
              "23 1 8:1 / / rw,relatime shared:1 - ext4 /dev/sda1 rw\n31 23 0:28 " + mounted +
                  " /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n");
        write("proc/self/cgroup", "0::" + group + "\n");
    }
    void version1(const std::string& group, const std::string& mounted = "/") {
        write("proc/self/mountinfo",
              "31 23 0:28 / /sys/fs/cgroup rw - tmpfs tmpfs rw,mode=755\n"
              "36 31 0:33 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n"
              "37 31 0:34 / /sys/fs/cgroup/cpuset rw - cgroup cgroup rw,cpuset\n"
              "32 31 0:29 " +
                  mounted +
                  " /sys/fs/cgroup/cpu,cpuacct rw master:9 - cgroup cgroup rw,cpu,cpuacct\n");
        write("proc/self/cgroup",
              "5:cpuset:/\n4:cpu,cpuacct:" + group + "\n3:memory:/other\n0::/\n");
    }
    std::optional<double> granted() const { return granted_cores(root_.string()); }

    fs::path root_;
};

TEST_F(GrantedCores, AreNotLimitedWithoutGroups) {
    EXPECT_FALSE(granted());
    unified("/");
    EXPECT_FALSE(granted());
    version1("/");
    EXPECT_FALSE(granted());
}

TEST_F(GrantedCores, AreQuotaByPeriodInVersion2) {
    unified("/farm/job");
    write("sys/fs/cgroup/farm/job/cpu.max", "150000 100000\n");
    EXPECT_EQ(granted(), 1.5);
    write("sys/fs/cgroup/farm/job/cpu.max", "max 100000\n");
    EXPECT_FALSE(granted());
}

TEST_F(GrantedCores, AreTheLeastOfTheGroupsAbove) {
    unified("/farm/job");
    write("sys/fs/cgroup/farm/job/cpu.max", "800000 100000\n");
    write("sys/fs/cgroup/farm/cpu.max", "50000 25000\n");
    EXPECT_EQ(granted(), 2);
    write("sys/fs/cgroup/farm/job/cpu.max", "100000 100000\n");
    EXPECT_EQ(granted(), 1);
}

TEST_F(GrantedCores, AreQuotaByPeriodInVersion1) {
    version1("/docker/1234");
    const std::string group = "sys/fs/cgroup/cpu,cpuacct/docker/1234";
    write(group + "/cpu.cfs_quota_us", "250000\n");
    write(group + "/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(granted(), 2.5);
    write(group + "/cpu.cfs_quota_us", "-1\n");
    EXPECT_FALSE(granted());
}

// A container's mount shows its group at the top, whatever /proc/self/cgroup calls it.
TEST_F(GrantedCores, AreFoundInsideAContainer) {
    for (const char* group : {"/docker/1234", "/", "/../.."}) {
        version1(group, "/docker/1234");
        write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "300000");
        write("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000");
        EXPECT_EQ(granted(), 3) << group;
        unified(group, "/docker/1234");
        write("sys/fs/cgroup/cpu.max", "400000 100000");
        EXPECT_EQ(granted(), 4) << group;
    }
}

TEST_F(GrantedCores, DoNotComeFromNonsense) {
    unified("/job");
    for (const char* text :
         {"", "0 100000", "100000 0", "much", "100000", "-5 100000", "nan nan"}) {
        write("sys/fs/cgroup/job/cpu.max", text);
        EXPECT_FALSE(granted()) << text;
    }
    write("proc/self/mountinfo", "cgroup2\n1 2 3 4 5 6 7 - cgroup2\n\n- - - - - - -\n");
    write("proc/self/cgroup", "0\n:\n");
    EXPECT_FALSE(granted());
}

TEST(UsableCores, AreThoseOfTheAffinity) {
    cpu_set_t before;
    ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
    EXPECT_LE(usable_cores(), CPU_COUNT(&before));
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int cpu = 0; CPU_COUNT(&one) == 0; ++cpu)
        if (CPU_ISSET(cpu, &before)) CPU_SET(cpu, &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    EXPECT_EQ(usable_cores(), 1);
    ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}

}  // namespace
}  // namespace kinora
