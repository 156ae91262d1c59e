// SPDX-License-Identifier: MIT
// Charts of VTK, in colours that the colour-blind can tell apart.
#include "hyoryu/view/plot.hpp"

#include "hyoryu/core/error.hpp"

#ifdef HYORYU_HAS_VTK
#include "hyoryu/io/results.hpp"
#include "offscreen_window.hpp"
#include "palette.hpp"
#include "png.hpp"

#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotLine.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <fmt/format.h>

#include <cmath>

namespace hyoryu {

namespace {

constexpr int title_height = 52; // [pixels]
constexpr int text_size = 20;
constexpr Rgb black{0, 0, 0};
constexpr Rgb grey{214, 214, 214};

// Okabe & Ito (2008), "Color Universal Design", the darker ones first.
constexpr std::array<Rgb, 6> colours{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}}};

constexpr std::array markers{vtkPlotPoints::CIRCLE, vtkPlotPoints::DIAMOND, vtkPlotPoints::SQUARE};

void use_sans(vtkTextProperty& text, int size)
{
    text.SetFontFamilyToArial();
    text.SetFontSize(size);
    text.SetBold(0);
    text.SetColor(0.1, 0.1, 0.1);
}

void set_pen(vtkPen& pen, const Rgb& colour, float width)
{
    pen.SetColor(colour[0], colour[1], colour[2]);
    pen.SetWidth(width);
}

vtkSmartPointer<vtkTable> table_of(const PlotCurve& curve, PlotPanel::Axes axes)
{
    auto table = vtkSmartPointer<vtkTable>::New();
    for (const char* name : {"x", "y"}) {
        vtkNew<vtkDoubleArray> column;
        column->SetName(name);
        table->AddColumn(column);
    }
    for (std::size_t k = 0; k < std::min(curve.x.size(), curve.y.size()); ++k) {
        if (axes == PlotPanel::Axes::linear || (curve.x[k] > 0 && curve.y[k] > 0)) {
            const vtkIdType row = table->InsertNextBlankRow();
            table->SetValue(row, 0, curve.x[k]);
            table->SetValue(row, 1, curve.y[k]);
        }
    }
    return table;
}

void add_curve(vtkChartXY& chart, const PlotCurve& curve, PlotPanel::Axes axes, int number)
{
    constexpr float line_width = 2.5F;
    constexpr float marker_size = 7.0F;
    const auto table = table_of(curve, axes);
    if (table->GetNumberOfRows() == 0) {
        return;
    }
    // VTK complains about a line through one point.
    const bool points = curve.style == PlotCurve::Style::points || table->GetNumberOfRows() == 1;
    auto* line =
        vtkPlotPoints::SafeDownCast(chart.AddPlot(points ? vtkChart::POINTS : vtkChart::LINE));
    line->SetInputData(table, 0, 1);
    line->SetLabel(curve.label);
    const bool theory = curve.style == PlotCurve::Style::theory;
    set_pen(*line->GetPen(), theory ? black : pick(colours, number), line_width);
    if (curve.style == PlotCurve::Style::dashed) {
        line->GetPen()->SetLineType(vtkPen::DASH_LINE);
    }
    if (points || curve.style == PlotCurve::Style::marked) {
        // Colours come again after a while: other shapes then.
        const auto round = static_cast<std::size_t>(number) / colours.size();
        line->SetMarkerStyle(markers[round % markers.size()]);
        line->SetMarkerSize(marker_size);
    }
}

// The largest of 1, 2 and 5 times a power of ten that is not above the value.
double round_down(double value)
{
    const double power = std::pow(10, std::floor(std::log10(value)));
    const double mantissa = value / power;
    return (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1) * power;
}

// Values to mark on a logarithmic axis; VTK's own are odd where the axis is shorter than a decade.
std::vector<double> logarithmic_ticks(double low, double high)
{
    std::vector<double> ticks;
    if (high < 4 * low) {
        const double step = round_down((high - low) / 4);
        for (double k = std::ceil(low / step); k * step <= high; ++k) {
            ticks.push_back(k * step);
        }
        return ticks;
    }
    const double ratio = high / low;
    const std::vector<double> mantissas = ratio > 1e4  ? std::vector<double>{1}
                                          : ratio > 25 ? std::vector<double>{1, 2, 5}
                                                       : std::vector<double>{1, 1.5, 2, 3, 4, 5, 7};
    for (double decade = std::floor(std::log10(low)); decade <= std::log10(high); ++decade) {
        for (const double mantissa : mantissas) {
            const double tick = mantissa * std::pow(10, decade);
            if (tick >= low && tick <= high) {
                ticks.push_back(tick);
            }
        }
    }
    return ticks;
}

void mark_logarithms(vtkAxis& axis, const std::vector<double>& range)
{
    vtkNew<vtkDoubleArray> positions;
    vtkNew<vtkStringArray> labels;
    for (const double tick : logarithmic_ticks(range[0], range[1])) {
        positions->InsertNextValue(std::log10(tick));
        labels->InsertNextValue(fmt::format("{:.6g}", tick));
    }
    axis.SetCustomTickPositions(positions, labels);
}

void set_axis(vtkAxis& axis, const std::string& title, const std::vector<double>& range)
{
    axis.SetTitle(title);
    use_sans(*axis.GetTitleProperties(), text_size);
    use_sans(*axis.GetLabelProperties(), text_size - 2);
    set_pen(*axis.GetPen(), black, 1.5F);
    set_pen(*axis.GetGridPen(), grey, 1.0F);
    if (!range.empty()) {
        axis.SetBehavior(vtkAxis::FIXED);
        axis.SetUnscaledRange(range[0], range[1]);
        if (axis.GetLogScaleActive()) {
            mark_logarithms(axis, range);
        }
    }
}

vtkSmartPointer<vtkChartXY> chart_of(const PlotPanel& panel)
{
    auto chart = vtkSmartPointer<vtkChartXY>::New();
    chart->SetTitle(panel.title);
    use_sans(*chart->GetTitleProperties(), text_size + 1);
    chart->SetShowLegend(true);
    int number = 0;
    for (const PlotCurve& curve : panel.curves) {
        add_curve(*chart, curve, panel.axes, number);
        number += curve.style == PlotCurve::Style::theory ? 0 : 1;
    }
    if (panel.axes == PlotPanel::Axes::logarithmic) {
        chart->GetAxis(vtkAxis::BOTTOM)->LogScaleOn();
        chart->GetAxis(vtkAxis::LEFT)->LogScaleOn();
    }
    set_axis(*chart->GetAxis(vtkAxis::BOTTOM), panel.x_axis, panel.x_range);
    set_axis(*chart->GetAxis(vtkAxis::LEFT), panel.y_axis, panel.y_range);
    use_sans(*chart->GetLegend()->GetLabelProperties(), text_size - 2);
    chart->GetLegend()->SetHorizontalAlignment(vtkChartLegend::RIGHT);
    chart->GetLegend()->SetVerticalAlignment(vtkChartLegend::TOP);
    return chart;
}

vtkSmartPointer<vtkTextActor> title_of(const Plot& plot, int width)
{
    auto title = vtkSmartPointer<vtkTextActor>::New();
    title->SetInput(plot.title.c_str());
    use_sans(*title->GetTextProperty(), text_size + 4);
    title->GetTextProperty()->SetJustificationToCentered();
    title->GetTextProperty()->SetVerticalJustificationToCentered();
    title->SetPosition(0.5 * width, plot.height - 0.5 * title_height);
    return title;
}

} // namespace

void draw(const Plot& plot, const std::filesystem::path& file)
{
    expects(!plot.panels.empty());
    const int width = plot.panel_width * static_cast<int>(plot.panels.size());
    const auto window = offscreen_window(width, plot.height);
    window->SetMultiSamples(8);
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(1, 1, 1);
    window->AddRenderer(renderer);
    vtkNew<vtkContextActor> sheet;
    renderer->AddActor(sheet);
    sheet->GetScene()->SetRenderer(renderer);
    const float chart_height = static_cast<float>(plot.height - title_height);
    float left = 0;
    for (const PlotPanel& panel : plot.panels) {
        const auto chart = chart_of(panel);
        chart->SetAutoSize(false);
        chart->SetSize(vtkRectf(left, 0, static_cast<float>(plot.panel_width), chart_height));
        sheet->GetScene()->AddItem(chart);
        left += static_cast<float>(plot.panel_width);
    }
    renderer->AddActor2D(title_of(plot, width));
    window->Render();
    write_text(file, png_of(*window));
}

} // namespace hyoryu

#else

namespace hyoryu {

void draw(const Plot&, const std::filesystem::path&)
{
    throw IoError("pictures need VTK, and this program was built without it (HYORYU_VTK=OFF)");
}

} // namespace hyoryu
#endif
