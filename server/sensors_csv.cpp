#include "server/sensors_csv.h"

#include "server/csv_table.h"

namespace patchlight::server {

void write_sensors_csv(const Scene& scene, const Solution& solution, const TextSink& sink) {
    CsvTable table("name,x,y,z,nx,ny,nz,irradiance_r,irradiance_g,irradiance_b,scalar,error", sink);
    for (std::size_t k = 0; k < solution.sensors.size(); ++k) {
        const Sensor& sensor = scene.sensors.at(k);
        const SensorReport& report = solution.sensors[k];
        table.text(sensor.name).numbers(sensor.position).numbers(sensor.normal);
        table.numbers(report.irradiance).number(luminance(report.irradiance)).number(report.error);
        table.end_row();
    }
    table.finish();
}

}  // namespace patchlight::server
