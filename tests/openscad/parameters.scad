/* [Size] */
// How wide it is
width = 20; // [5:0.5:100]
offsets = [1, 2, 3]; // [0:10]
/* [Look] */
name = "box"; // [box, lid:Cover]
round = true;
count = 3; // [1:one, 2:two, 3:three]
/* [Hidden] */
quality = 40;

module unused() {
}
echo(width, name, round, offsets, count);
