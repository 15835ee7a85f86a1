#include "experiments/run/version.hpp"

#include <fmt/format.h>

#include <string>

#include "bendlab_changes.hpp"  // both are written by version.cmake at every build
#include "bendlab_version.hpp"

namespace bendlab {

const BuildInfo& build_info() {
  static const BuildInfo info{.version = BENDLAB_VERSION,
                              .git_commit = BENDLAB_GIT_COMMIT,
                              .git_dirty = BENDLAB_GIT_DIRTY,
                              .source_hash = BENDLAB_SOURCE_HASH,
                              .compiler = BENDLAB_COMPILER,
                              .flags = BENDLAB_FLAGS,
                              .build_type = BENDLAB_BUILD_TYPE,
                              .changes = {reinterpret_cast<const char*>(changes), sizeof changes - 1},
                              .changes_id = changes_hash};
  return info;
}

std::string changes_file_name() {
  const BuildInfo& info = build_info();
  return fmt::format("{}{}", info.changes_id, info.changes.empty() ? "" : ".patch.gz");
}

std::string_view version_text() {
  static const std::string text = [] {
    const BuildInfo& info = build_info();
    return fmt::format("bendlab {} (commit {}{}, sources {}, {}, {})", info.version,
                       info.git_commit.substr(0, 12), info.git_dirty ? " + changes" : "", info.source_hash,
                       info.compiler, info.build_type);
  }();
  return text;
}

}  // namespace bendlab
