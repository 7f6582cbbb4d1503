// Places of messages about used files: most are shown from the folder of this script, those about operators, ranges and
// arguments from the folder of the used file.
use <parts/used_places.inc>
echo(mistakes());
misplaced(1, 2);
