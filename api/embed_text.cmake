# Writes a C++ source that defines a function returning the text of a file.
# Called with -DINPUT=, -DOUTPUT=, -DHEADER= (that declares the function) and -DFUNCTION=.
file(READ ${INPUT} hex HEX)
string(REGEX REPLACE "0a" "0a\n" lines "${hex}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${lines}")
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

namespace raywatch {
namespace {
constexpr char kText[] = {
${bytes}};
}  // namespace

std::string_view ${FUNCTION}() { return {kText, sizeof(kText)}; }

}  // namespace raywatch
")
