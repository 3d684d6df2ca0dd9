#include "driver/keys.hpp"

namespace brisance::driver {
namespace {

class Describer : public KeyDescriber<Describer> {
 public:
  /// The keys that a segment has in this mode alone.
  template <class Mode>
  void describe_mode(const std::string& path, std::string_view mode) {
    const std::size_t before = rows_.size();
    describe_all<Mode>(path);
    for (std::size_t i = before; i < rows_.size(); ++i)
      rows_[i].meaning = "with mode = \"" + std::string(mode) + "\": " + rows_[i].meaning;
  }

 private:
  friend KeyDescriber<Describer>;
  using KeyDescriber<Describer>::describe;

  template <class K>
  void describe(const std::string& path, const K& key, const OpenTable&) {
    add(path, key, "a table [" + path + ']');
  }
  template <class K>
  void describe(const std::string& path, const K& key, const SymmetricTable&) {
    add(path, key, "a table of some of xx, yy, zz, yz, xz, xy, each " + numbers(key));
  }
  template <class K>
  void describe(const std::string& path, const K& key, const GeneralTable&) {
    add(path, key, "a table of some of xx, xy, xz, yx, yy, yz, zx, zy, zz, each " + numbers(key));
  }

  template <class K>
  void add_tables(const std::string& path, const K& key) {
    add(path, key, "a list of tables [[" + path + "]]");
  }
  void describe(const std::string& path, const Key<GroupKeys, OpenTables>& key, const OpenTables&) { add_tables(path, key); }
  void describe(const std::string& path, const Key<PathKeys, OpenTables>& key, const OpenTables&) {
    add_tables(path, key);
    describe_all<SegmentKeys>(path);
    [&]<class... Mode>(std::type_identity<std::variant<Mode...>>) {
      std::size_t i = 0;
      (describe_mode<Mode>(path, choices<ModeName>[i++]), ...);
    }(std::type_identity<ModeKeys>{});
    describe_all<ComponentKeys>(path);
    describe_all<GroupKeys>(path);
  }
  void describe(const std::string& path, const Key<ComparisonKeys, OpenTables>& key, const OpenTables&) {
    add_tables(path, key);
    describe_all<ExperimentKeys>(path);
  }
  void describe(const std::string& path, const Key<CalibrationKeys, OpenTables>& key, const OpenTables&) {
    add_tables(path, key);
    if (key.member == &CalibrationKeys::experiments)
      describe_all<ExperimentKeys>(path);
    else
      describe_all<ParameterKeys>(path);
  }
};

template <class File>
std::vector<KeyDescription> described() {
  Describer describer;
  describer.describe_all<File>("");
  return describer.take();
}

}  // namespace

const std::vector<FileKind>& file_kinds() {
  static const std::vector<FileKind> kinds = {{"path file", "run", described<PathKeys>()},
                                              {"comparison file", "compare", described<ComparisonKeys>()},
                                              {"calibration file", "calibrate", described<CalibrationKeys>()}};
  return kinds;
}

}  // namespace brisance::driver
