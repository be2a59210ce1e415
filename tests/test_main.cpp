// tests/test_main.cpp: main of every GoogleTest program. A run that skipped all its tests says so
// to CTest, which then counts it as skipped.
#include <gtest/gtest.h>

int main(int argc, char** argv) {
    constexpr int kSkipped = 77;  // SKIP_RETURN_CODE of tests/CMakeLists.txt
    testing::InitGoogleTest(&argc, argv);
    int result = RUN_ALL_TESTS();
    const testing::UnitTest& tests = *testing::UnitTest::GetInstance();
    bool all_skipped =
        tests.test_to_run_count() > 0 && tests.skipped_test_count() == tests.test_to_run_count();
    return result == 0 && all_skipped ? kSkipped : result;
}
