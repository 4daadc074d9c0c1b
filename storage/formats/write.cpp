#include "storage/formats/write.hpp"
