/** openCARP's results, dropped on a mesh. */
import { igbFile, textFile } from './files';
import { dropFile, expect, idle, openAndRun, test } from './support';

const ball = {
  source: { phantom: { kind: 'sphere', radius_mm: 8, spacing_mm: [1, 1, 1] } },
  sizing: { edge_mm: 3 },
};

test('a .dat colours the mesh, an .igb plays on it, and those of another mesh are refused', async ({
  page,
}) => {
  await openAndRun(page, ball);
  await dropFile(page, textFile('lat.dat', '1\n2\n3\n'));
  const refused = page.getByRole('alert').filter({ hasText: 'lat.dat' });
  await expect(refused).toContainText('found 3 values, expected');
  const points = Number((await refused.innerText()).match(/expected (\d+), one for each point/)?.[1]);
  expect(points).toBeGreaterThan(50);
  await refused.getByRole('button', { name: 'Dismiss' }).click();

  await dropFile(page, textFile('heart.activation_ms.dat', '12.5\n'.repeat(points)));
  const colours = page.getByRole('combobox', { name: 'Colour by' });
  await expect(colours).toHaveValue('activation_ms');
  await idle(page);

  await dropFile(page, igbFile('vm.igb', points, [-80, -30, 20], 10));
  const player = page.getByRole('group', { name: 'Player' });
  await expect(player).toHaveAttribute('data-frames', '3');
  await expect(colours).toHaveValue('vm');
  await expect(player.getByRole('slider', { name: 'Time' })).toHaveAttribute('max', '20');
  await idle(page);

  await dropFile(page, igbFile('short.igb', points - 1, [0], 1));
  await expect(page.getByRole('alert')).toContainText(
    `short.igb: found ${points - 1} values in a frame, expected ${points}`,
  );
});
