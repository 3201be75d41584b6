#include "core/files/hdf5_handle.hpp"

#include <atomic>

namespace grainfield::core {
namespace {

std::recursive_mutex& session_mutex() {
    static std::recursive_mutex mutex;
    return mutex;
}

}  // namespace

Hdf5Session::Hdf5Session() : lock_(session_mutex()) {
    // After a damaged file HDF5 may find no end in cleaning up at exit, and says so on stderr. Our
    // files are in memory, nothing waits to be written then. Counts only before any other call.
    static const herr_t no_cleaning_up = H5dont_atexit();
    (void)no_cleaning_up;
    H5Eget_auto2(H5E_DEFAULT, &printer_, &printer_data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Session::~Hdf5Session() {
    H5Eset_auto2(H5E_DEFAULT, printer_, printer_data_);
}

std::string hdf5_error() {
    std::string message;
    const auto keep_innermost = [](unsigned, const H5E_error2_t* error, void* out) -> herr_t {
        if (error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &message);
    H5Eclear2(H5E_DEFAULT);
    return message.empty() ? "unknown HDF5 error" : message;
}

hid_t hdf5_memory_type(Hdf5Type type) {
    switch (type) {
        case Hdf5Type::float64:
            return H5T_NATIVE_DOUBLE;
        case Hdf5Type::int32:
            return H5T_NATIVE_INT32;
        case Hdf5Type::int64:
            return H5T_NATIVE_INT64;
        case Hdf5Type::uint8:
            return H5T_NATIVE_UINT8;
    }
    return H5I_INVALID_HID;
}

hid_t hdf5_disk_type(Hdf5Type type) {
    switch (type) {
        case Hdf5Type::float64:
            return H5T_IEEE_F64LE;
        case Hdf5Type::int32:
            return H5T_STD_I32LE;
        case Hdf5Type::int64:
            return H5T_STD_I64LE;
        case Hdf5Type::uint8:
            return H5T_STD_U8LE;
    }
    return H5I_INVALID_HID;
}

Hdf5Handle hdf5_in_memory_access() {
    Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    constexpr std::size_t growth = std::size_t{4} << 20;
    H5Pset_fapl_core(access, growth, false);
    // The layout of HDF5 1.10: all metadata carry checksums, and attributes may be long. Older
    // layouts do not protect the index of chunks, where a flipped bit switches the data's own
    // checksum off.
    H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_LATEST);
    return access;
}

std::string hdf5_in_memory_name() {
    static std::atomic<unsigned> counter{0};
    return "in memory " + std::to_string(counter.fetch_add(1));
}

}  // namespace grainfield::core
