include <parts/included.inc>
use <parts/used.inc>
q = 3;
echo(used_function(1));
used_module();
included_module();
echo(used_variable);
q = 4;
