#include "core/vector/spatial_order.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/base/tasks.hpp"

namespace grainfield::core {
namespace {

constexpr std::size_t leaf = 8;                // spheres that are not divided further
constexpr std::size_t worth_a_thread = 10000;  // spheres

class Bisection {
  public:
    Bisection(const Vec3Column& position, SpatialOrder& order)
        : position_(position), order_(order) {}

    /// Orders slots begin <= k < end, which are domains first, first + 1, ...
    void divide(std::size_t begin, std::size_t end, std::size_t first, std::size_t domains) {
        if (domains <= 1 && end - begin <= leaf) return;
        std::size_t low_domains = 0, middle = begin + (end - begin) / 2;
        if (domains > 1) {
            low_domains = domains / 2;
            middle = begin + (end - begin) * low_domains / domains;
            order_.first[first + low_domains] = middle;
        }
        const Column<double>& x = longest_axis(begin, end);
        const auto at = [&](std::size_t k) {
            return order_.sphere.begin() + static_cast<std::ptrdiff_t>(k);
        };
        std::nth_element(at(begin), at(middle), at(end), [&x](std::int32_t a, std::int32_t b) {
            return std::tie(x[a], a) < std::tie(x[b], b);
        });
        const auto low = [&] { divide(begin, middle, first, low_domains); };
        const auto high = [&] { divide(middle, end, first + low_domains, domains - low_domains); };
        if (end - begin > worth_a_thread) {
            both(low, high);
        } else {
            low();
            high();
        }
    }

  private:
    const Column<double>& longest_axis(std::size_t begin, std::size_t end) const {
        Vec3 lower = position_[order_.sphere[begin]], upper = lower;
        for (std::size_t k = begin; k < end; ++k) {
            const Vec3 x = position_[order_.sphere[k]];
            lower = lower.cwiseMin(x);
            upper = upper.cwiseMax(x);
        }
        int axis = 0;
        (upper - lower).maxCoeff(&axis);
        return axis == 0 ? position_.x : axis == 1 ? position_.y : position_.z;
    }

    const Vec3Column& position_;
    SpatialOrder& order_;
};

}  // namespace

SpatialOrder order_in_space(const Vec3Column& position, std::size_t domain_size) {
    const std::size_t n = position.size();
    const std::size_t domains = std::max<std::size_t>(1, (n + domain_size / 2) / domain_size);
    SpatialOrder order;
    order.sphere.resize(n);
    std::iota(order.sphere.begin(), order.sphere.end(), 0);
    order.first.assign(domains + 1, 0);
    order.first.back() = n;
    if (n > 0) Bisection(position, order).divide(0, n, 0, domains);
    return order;
}

}  // namespace grainfield::core
