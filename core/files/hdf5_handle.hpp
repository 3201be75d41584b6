#pragma once
// The little of HDF5's C interface that readers and writers share: handles that close themselves,
// errors that are thrown instead of printed, one thread at a time.

#include <hdf5.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

namespace grainfield::core {

/// While it lives, HDF5 prints nothing and belongs to this thread (Debian's build keeps global
/// state without a lock).
class Hdf5Session {
  public:
    Hdf5Session();
    ~Hdf5Session();
    Hdf5Session(const Hdf5Session&) = delete;
    Hdf5Session& operator=(const Hdf5Session&) = delete;

  private:
    std::unique_lock<std::recursive_mutex> lock_;
    H5E_auto2_t printer_ = nullptr;
    void* printer_data_ = nullptr;
};

/// The innermost message on HDF5's error stack, the one that says why.
std::string hdf5_error();

/// An id with the function that closes it.
class Hdf5Handle {
  public:
    using Close = herr_t (*)(hid_t);
    Hdf5Handle() = default;
    Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
    Hdf5Handle(Hdf5Handle&& other) noexcept
        : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
    Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    ~Hdf5Handle() {
        if (id_ >= 0) close_(id_);
    }

    explicit operator bool() const { return id_ >= 0; }
    operator hid_t() const { return id_; }  // NOLINT: it stands for the id in every call

  private:
    hid_t id_ = H5I_INVALID_HID;
    Close close_ = nullptr;
};

/// Element types that we store. In memory native, on disk little endian.
enum class Hdf5Type { float64, int32, int64, uint8 };
hid_t hdf5_memory_type(Hdf5Type type);
hid_t hdf5_disk_type(Hdf5Type type);

template <class T>
constexpr Hdf5Type hdf5_type = Hdf5Type::float64;
template <>
inline constexpr Hdf5Type hdf5_type<std::int32_t> = Hdf5Type::int32;
template <>
inline constexpr Hdf5Type hdf5_type<std::int64_t> = Hdf5Type::int64;
template <>
inline constexpr Hdf5Type hdf5_type<std::uint8_t> = Hdf5Type::uint8;

/// Files live in memory while HDF5 works on them, so that it never meets a full disk or half a
/// file (it cannot give up a file whose writing failed). These are the properties for that.
Hdf5Handle hdf5_in_memory_access();

/// A name for such a file. HDF5 refuses to have the same name open twice, on disk or not.
std::string hdf5_in_memory_name();

}  // namespace grainfield::core
