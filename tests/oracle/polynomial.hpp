// SPDX-License-Identifier: Apache-2.0
// Polynomials of small degree in long double, and their roots by bisection.
#pragma once

#include <algorithm>
#include <vector>

namespace gnomon::oracle {

/// Coefficients from the constant upwards.
class Polynomial {
public:
    using Real = long double;

    Polynomial(std::vector<Real> coefficients) : coefficients_(std::move(coefficients)) {}
    static Polynomial between(double start, double end) { return Polynomial({start, Real(end) - start}); }

    Real operator()(Real t) const {
        Real value = 0.0L;
        for (size_t i = coefficients_.size(); i-- > 0;) value = value * t + coefficients_[i];
        return value;
    }

    friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
        std::vector<Real> product(a.coefficients_.size() + b.coefficients_.size() - 1, 0.0L);
        for (size_t i = 0; i < a.coefficients_.size(); ++i) {
            for (size_t j = 0; j < b.coefficients_.size(); ++j) product[i + j] += a.coefficients_[i] * b.coefficients_[j];
        }
        return product;
    }
    friend Polynomial operator+(const Polynomial& a, const Polynomial& b) { return combine(a, b, 1.0L); }
    friend Polynomial operator-(const Polynomial& a, const Polynomial& b) { return combine(a, b, -1.0L); }

    /// Where the sign changes in [0, 1], ascending. Double roots, where it does not, may be missing.
    std::vector<Real> sign_changes() const {
        std::vector<Real> result;
        if (coefficients_.size() < 2) return result;
        std::vector<Real> ends = derivative().sign_changes();
        ends.insert(ends.begin(), 0.0L);
        ends.push_back(1.0L);
        for (size_t i = 0; i + 1 < ends.size(); ++i) {  // Monotone in between.
            Real low = ends[i], high = ends[i + 1];
            const bool rises = (*this)(high) > 0.0L;
            if (((*this)(low) > 0.0L) == rises) continue;
            for (int step = 0; step < 70; ++step) {
                const Real middle = 0.5L * (low + high);
                (((*this)(middle) > 0.0L) == rises ? high : low) = middle;
            }
            result.push_back(0.5L * (low + high));
        }
        return result;
    }

private:
    static Polynomial combine(const Polynomial& a, const Polynomial& b, Real sign) {
        std::vector<Real> sum(std::max(a.coefficients_.size(), b.coefficients_.size()), 0.0L);
        for (size_t i = 0; i < a.coefficients_.size(); ++i) sum[i] += a.coefficients_[i];
        for (size_t i = 0; i < b.coefficients_.size(); ++i) sum[i] += sign * b.coefficients_[i];
        return sum;
    }
    Polynomial derivative() const {
        std::vector<Real> slope;
        for (size_t i = 1; i < coefficients_.size(); ++i) slope.push_back(coefficients_[i] * static_cast<Real>(i));
        return slope;
    }

    std::vector<Real> coefficients_;
};

}  // namespace gnomon::oracle
