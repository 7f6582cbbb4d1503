include <parts/none.inc>
use <parts/none_either.inc>
cube();
