// What this program was built from: recorded in every run, part of every run's id.
#pragma once

#include <string>
#include <string_view>

namespace bendlab {

struct BuildInfo {
  std::string_view version;      ///< of the project
  std::string_view git_commit;   ///< 40 hex digits; "unknown" outside a git checkout
  bool git_dirty = false;        ///< sources or build files differed from that commit
  std::string_view source_hash;  ///< 16 hex digits over the sources that decide results: all of lib/bendlab
                                 ///< and experiments/*.{hpp,cpp} (not experiments/cli)
  std::string_view compiler;     ///< name and version
  std::string_view flags;        ///< compiler flags, space-separated
  std::string_view build_type;   ///< Release, Debug, RelWithDebInfo
  std::string_view changes;  ///< since that commit: a patch, packed by gzip; empty: none, or more than 4 MB
  std::string_view changes_id;  ///< 16 hex digits of the patch; empty: none
};

const BuildInfo& build_info();

/// Of the file beside runs that holds `changes`; says so if they are too many to be kept.
std::string changes_file_name();

/// One line for `bendlab --version`.
std::string_view version_text();

}  // namespace bendlab
