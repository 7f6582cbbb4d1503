for (i = [0:9]) cube("a");
for (i = [0:2]) { cube("a"); echo(1); }
for (i = [0:7]) echo("same");
for (i = [0:7]) echo(unknown);
