// Brings the page to life: tables in any case, curves where D3 is there.

function start() {
  document.querySelectorAll("table.sortable").forEach(makeSortable);
  if (typeof d3 === "undefined") return;
  const content = JSON.parse(document.getElementById("data").textContent);
  const studies = content.studies.map((figures, i) => ({id: "s" + i, figures}));
  for (const study of studies) {
    for (const data of study.figures) Object.assign(data, {hidden: new Set(), chosen: {}, choices: [], views: []});
  }
  document.querySelectorAll("figure.curve").forEach((figure, number) => {
    const study = studies[Number(figure.dataset.study)];
    const data = study.figures[Number(figure.dataset.data)];
    data.views.push(drawCurve(figure, data, data.figures[Number(figure.dataset.figure)], study, number));
  });
  studies.forEach(linkRows);
}

start();
