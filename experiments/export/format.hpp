// The formats of other programs to which a run can be exported. To add a format, write one file here and add
// one row in format.cpp.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/export/exported_run.hpp"
#include "experiments/export/output.hpp"

namespace bendlab {

/// How much of a run a single file can hold, if --to names a file.
enum class InOneFile { nothing, a_frame, everything };

struct Format {
  std::string_view name;     ///< for --format; also the extension of its files
  std::string_view summary;  ///< one line about the files that it writes
  InOneFile in_one_file = InOneFile::nothing;
  bool has_times = false;      ///< false: other programs assume evenly spaced frames
  bool states_origin = false;  ///< positions of a run far from 0 are relative to ExportedRun::origin
  /// Throws RunFileError, ExportStopped.
  void (*write)(const ExportedRun& run, Output& output) = nullptr;
};

/// All formats, in the order of the table in format.cpp.
std::span<const Format* const> formats();

/// The format of that name, or nullptr.
const Format* find_format(std::string_view name);

/// A line for comments in files: program, run, experiment, units.
std::string description_of(const ExportedRun& run);

/// A surface of a run as OBJ text, with its texture coordinates, if any. Positions have as few digits as
/// possible, but enough to read the same numbers again (floats, if the run stored floats).
class ObjText {
 public:
  /// `run` and `surface` must outlive this object. Positions are relative to `origin`; the text states an
  /// `origin` that is not 0.
  ObjText(const ExportedRun& run, const Surface& surface, const Vector3& origin = Vector3::Zero());

  void write(OutputFile& file, const ExportedFrame& frame) const;

 private:
  const ExportedRun& run_;
  const Surface& surface_;
  Vector3 origin_;
  std::string head_, tail_;  // the same in every frame
};

struct ExportOptions {
  std::string frames;                       ///< see open_for_export()
  std::optional<UpAxis> up;                 ///< see open_for_export()
  std::filesystem::path to;                 ///< empty: export/<format> beside the run file
  bool force = false;                       ///< replace existing files
  const std::atomic<bool>* stop = nullptr;  ///< true: stop; null: cannot be stopped
};

struct Exported {
  std::filesystem::path to;
  std::vector<ExportedFrame> frames;
  std::vector<std::string> surfaces;  ///< their names
  std::size_t files = 0;
  std::uint64_t bytes = 0;
  std::vector<std::string> notes;  ///< parts that are left out, with the reason; lost times
};

/// Writes a run's frames in a format. No file appears before all files are complete. Throws UsageError for
/// options that do not go together or for a file that exists; RunFileError; ExportStopped.
Exported export_run(const RunRecord& record, const Format& format, const ExportOptions& options);

}  // namespace bendlab
