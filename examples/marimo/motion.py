import marimo

app = marimo.App()


@app.cell
def _():
    import marimo as mo
    from motion_widgets import BananaMachine

    simulation = mo.ui.anywidget(BananaMachine(omega=0.8, samples=20000))
    simulation
    return simulation, mo


@app.cell
def _(simulation, mo):
    mo.md(f"turn rate {simulation.value['omega']} rad/s")
    return


@app.cell
def _(simulation, mo):
    mo.ui.button(label="Hard arc", on_click=lambda _: setattr(simulation, "preset", "hard"))
    return


if __name__ == "__main__":
    app.run()
