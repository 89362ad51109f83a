// SPDX-License-Identifier: Apache-2.0
// The text of the progress bar.
#include "progress.hpp"

#include <gtest/gtest.h>

namespace gnomon::test {

TEST(Progress, ShareRateAndTimeLeft) {
    EXPECT_EQ(cli::progress_text(0.5, 10.0, 40e6), "[############............]  50 %  2 Msamples/s  0:10 left");
    EXPECT_EQ(cli::progress_text(0.25, 50.0, 1e6), "[######..................]  25 %  0.005 Msamples/s  2:30 left");
    EXPECT_EQ(cli::progress_text(0.01, 100.0, 1e6), "[........................]   1 %  0.0001 Msamples/s  2:45:00 left");
    EXPECT_EQ(cli::progress_text(1.0, 10.0, 10e6), "[########################] 100 %  1 Msamples/s  0:00 left");
}

TEST(Progress, NothingIsClaimedBeforeTheFirstSample) {
    EXPECT_EQ(cli::progress_text(0.0, 1.0, 1e6), "[........................]   0 %");
    EXPECT_EQ(cli::progress_text(-1.0, 1.0, 1e6), "[........................]   0 %");
}

}  // namespace gnomon::test
