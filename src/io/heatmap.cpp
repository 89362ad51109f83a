// SPDX-License-Identifier: Apache-2.0
// Based on: the colour map viridis (van der Walt and Smith 2015), as a polynomial of degree six by Zucker 2018, CC0.
#include "io/heatmap.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace gnomon::io {

namespace {

using Colour = std::array<uint8_t, 3>;

constexpr Colour kBlack = {0, 0, 0}, kPaper = {255, 255, 255}, kInk = {40, 44, 52};
constexpr uint32_t kLeastHeight = 120, kMostHeight = 400;  // Of the scale.
constexpr uint32_t kGap = 12, kBar = 16, kPixel = 2;
constexpr uint32_t kDigitWidth = 3, kDigitHeight = 5;

// Rows of 3 bits.
constexpr std::array<std::array<uint8_t, kDigitHeight>, 10> kDigits = {{{7, 5, 5, 5, 7},
                                                                        {2, 6, 2, 2, 7},
                                                                        {7, 1, 7, 4, 7},
                                                                        {7, 1, 7, 1, 7},
                                                                        {5, 5, 7, 1, 1},
                                                                        {7, 4, 7, 1, 7},
                                                                        {7, 4, 7, 5, 7},
                                                                        {7, 1, 2, 2, 2},
                                                                        {7, 5, 7, 5, 7},
                                                                        {7, 5, 7, 1, 7}}};

class Canvas {
public:
    Canvas(uint32_t width, uint32_t height) : picture_{width, height, std::vector<uint8_t>(uint64_t(width) * height * 3)} {
        fill(0, 0, width, height, kPaper);
    }

    void set(uint32_t x, uint32_t y, const Colour& colour) {
        assert(x < picture_.width && y < picture_.height);
        std::copy(colour.begin(), colour.end(),
                  picture_.rgb.begin() + static_cast<ptrdiff_t>((uint64_t(y) * picture_.width + x) * 3));
    }

    void fill(uint32_t x, uint32_t y, uint32_t width, uint32_t height, const Colour& colour) {
        for (uint32_t j = y; j < y + height; ++j)
            for (uint32_t i = x; i < x + width; ++i) set(i, j, colour);
    }

    void write(uint32_t x, uint32_t y, const std::string& digits) {
        for (const char digit : digits) {
            for (uint32_t row = 0; row < kDigitHeight; ++row)
                for (uint32_t column = 0; column < kDigitWidth; ++column)
                    if ((kDigits[static_cast<size_t>(digit - '0')][row] >> (kDigitWidth - 1 - column) & 1) != 0)
                        fill(x + column * kPixel, y + row * kPixel, kPixel, kPixel, kInk);
            x += (kDigitWidth + 1) * kPixel;
        }
    }

    Heatmap take() { return std::move(picture_); }

private:
    Heatmap picture_;
};

double share_of(uint32_t count, uint32_t most) { return most > 1 ? std::log(count) / std::log(most) : 1.0; }

uint32_t digits_width(const std::string& digits) { return static_cast<uint32_t>(digits.size()) * (kDigitWidth + 1) * kPixel; }

/// In a column at x, so high, top to bottom: the most to 1, and nothing.
void draw_scale(Canvas& canvas, uint32_t x, uint32_t height, uint32_t most) {
    constexpr uint32_t kTop = 10, kNone = 12;
    const uint32_t length = height - 2 * kTop - 2 * kNone, bottom = kTop + length, text_x = x + kBar + 6,
                   half = kDigitHeight * kPixel / 2;
    for (uint32_t row = 0; row <= length && most > 0; ++row)
        canvas.fill(x, kTop + row, kBar, 1, viridis(1.0 - double(row) / length));
    uint32_t last = bottom + kNone * 2;
    const auto mark = [&](uint32_t count) {
        const auto y = static_cast<uint32_t>(std::lround(bottom - share_of(count, most) * length));
        canvas.fill(x + kBar, y, 3, 1, kInk);
        canvas.write(text_x, y - half, std::to_string(count));
        last = y;
    };
    if (most > 0) mark(most);
    const uint32_t top = last;
    if (most > 1) mark(1);
    for (uint32_t count = 2; count < most; count *= 2) {
        const auto y = static_cast<uint32_t>(std::lround(bottom - share_of(count, most) * length));
        constexpr uint32_t kApart = kDigitHeight * kPixel + 3;
        if (y + kApart <= last && y >= top + kApart) mark(count);
        if (count > most / 2) break;
    }
    canvas.fill(x, bottom + kNone, kBar, kNone, kBlack);
    canvas.write(text_x, bottom + kNone + kNone / 2 - half, "0");
}

}  // namespace

Colour viridis(double share) {
    constexpr double kCoefficients[7][3] = {{0.2777273272234177, 0.005407344544966578, 0.3340998053353061},
                                            {0.1050930431085774, 1.404613529898575, 1.384590162594685},
                                            {-0.3308618287255563, 0.214847559468213, 0.09509516302823659},
                                            {-4.634230498983486, -5.799100973351585, -19.33244095627987},
                                            {6.228269936347081, 14.17993336680509, 56.69055260068105},
                                            {4.776384997670288, -13.74514537774601, -65.35303263337234},
                                            {-5.435455855934631, 4.645852612178535, 26.3124352495832}};
    const double t = std::clamp(share, 0.0, 1.0);
    Colour colour{};
    for (size_t i = 0; i < 3; ++i) {
        double value = 0.0;
        for (size_t k = std::size(kCoefficients); k-- > 0;) value = value * t + kCoefficients[k][i];
        colour[i] = static_cast<uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
    }
    return colour;
}

Heatmap heatmap(std::span<const uint32_t> counts, uint32_t width) {
    const auto height = static_cast<uint32_t>(counts.size() / width);
    const uint32_t most = *std::max_element(counts.begin(), counts.end());
    const uint32_t labels = digits_width(std::to_string(std::max(1u, most)));
    Canvas canvas(width + kGap + kBar + 6 + labels + kGap, std::max(height, kLeastHeight));
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const uint32_t count = counts[uint64_t(y) * width + x];
            canvas.set(x, y, count == 0 ? kBlack : viridis(share_of(count, most)));
        }
    }
    draw_scale(canvas, width + kGap, std::clamp(height, kLeastHeight, kMostHeight), most);
    return canvas.take();
}

}  // namespace gnomon::io
