use <ombre>
module graded(size) fgrade(["x/size +* 2", "1"], ["white", "blakc"]) cube(size);
graded(5);
