function sum(v, i = 0, total = 0) = i == len(v) ? total : sum(v, i + 1, total + v[i]);
values = [for (i = [0:9999]) i];
echo(sum(values), len(values), values[5000]);
echo(sum([for (i = [0:99]) for (j = [0:99]) if ((i + j) % 2 == 0) 1]));
